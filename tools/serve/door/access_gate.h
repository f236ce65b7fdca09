// SPDX-License-Identifier: Apache-2.0
// Decides who has access and who may write, from a request's headers alone, before its body is read.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/serve/door/request.h"

namespace indurop::serve {

struct Token {
  std::string name;  // for the audit log
  std::string value;
  Role role = Role::Program;
};

// Clients that sign in, and tokens that are kept as hashes. Called by any thread.
class Accounts {
 public:
  Accounts() = default;
  Accounts(const Accounts&) = delete;
  Accounts& operator=(const Accounts&) = delete;
  virtual ~Accounts() = default;
  // Returns the client that has this token; nothing if none has. `use`: counts as use of its session.
  virtual std::optional<Client> client_of_token(std::string_view token, bool use) = 0;
};

struct AccessGateSettings {
  bool loopback = true;  // the server can be reached from this machine only
  bool tls = false;
  bool write = false;
  std::vector<std::string> hosts;  // lower-case names and addresses of this server
  std::vector<Token> tokens;
  std::vector<std::string> origins;  // of third-party pages that may follow variables
};

class AccessGate {
 public:
  // `accounts`: null: there are none but the tokens of the settings. Must outlive the gate.
  explicit AccessGate(AccessGateSettings settings, Accounts* accounts = nullptr)
      : settings_(std::move(settings)), accounts_(accounts) {}

  // Returns the refusal of a request that needs this, or nothing if it is allowed. Its `client` is that of client_of().
  [[nodiscard]] std::optional<Reply> refuse(const Request& request, const Needed& needed) const;
  // Returns the client identified by the token, else by the certificate.
  [[nodiscard]] Client client_of(const Request& request) const;
  // Returns true if the client may do what this role may, on some board at least.
  [[nodiscard]] bool may(const Client& client, Role role) const {
    return client.role >= role && (role <= Role::Look || settings_.write);
  }
  [[nodiscard]] const AccessGateSettings& settings() const noexcept { return settings_; }

 private:
  [[nodiscard]] bool host_known(std::string_view host) const;
  [[nodiscard]] bool same_origin(const Request& request) const;
  [[nodiscard]] std::optional<Reply> refuse_client(const Client& client, const Needed& needed) const;
  [[nodiscard]] Client client_of_token(std::string_view sent, bool use) const;

  AccessGateSettings settings_;
  Accounts* accounts_;
};

// Returns name or address of a Host header, in lower case and without the port; empty: it is not a valid Host.
std::string host_name(std::string_view host);

// Returns the token that a request sends in a header or, for the WebSocket of a browser, in a subprotocol. Empty: none.
std::string_view sent_token(const Request& request);

// Takes the same time wherever the two texts differ.
bool equal_in_constant_time(std::string_view a, std::string_view b) noexcept;

}  // namespace indurop::serve
