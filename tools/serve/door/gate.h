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
  Role role = Role::Writer;
};

struct GateSettings {
  bool loopback = true;  // the server can be reached from this machine only
  bool tls = false;
  bool write = false;
  std::vector<std::string> hosts;  // lower-case names and addresses of this server
  std::vector<Token> tokens;
  std::vector<std::string> origins;  // of third-party pages that may follow variables
};

class Gate {
 public:
  explicit Gate(GateSettings settings) : settings_(std::move(settings)) {}

  // Returns the refusal of a request that needs `right`, or nothing if it is allowed.
  [[nodiscard]] std::optional<Reply> refuse(const Request& request, Right right) const;
  // Returns the client identified by the token, else by the certificate.
  [[nodiscard]] Client client_of(const Request& request) const;
  [[nodiscard]] bool may_write(const Client& client) const { return settings_.write && client.role == Role::Writer; }
  [[nodiscard]] const GateSettings& settings() const noexcept { return settings_; }

 private:
  [[nodiscard]] bool host_known(std::string_view host) const;
  [[nodiscard]] bool same_origin(const Request& request) const;
  [[nodiscard]] std::optional<Reply> refuse_client(const Client& client, Right right) const;

  GateSettings settings_;
};

// Returns name or address of a Host header, in lower case and without the port; empty: it is not a valid Host.
std::string host_name(std::string_view host);

// Takes the same time wherever the two texts differ.
bool equal_in_constant_time(std::string_view a, std::string_view b) noexcept;

}  // namespace indurop::serve
