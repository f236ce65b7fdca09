// SPDX-License-Identifier: Apache-2.0
// A connection to a server, TCP or TLS. No call waits longer than a few seconds.

#pragma once

#include <indurop/result.h>
#include <openssl/ssl.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/descriptor.h"
#include "core/base/problem.h"
#include "doors/mqtt/serve/address.h"

namespace indurop::mqtt {

// Used by one thread.
class Connection {
 public:
  // `ca`: authority of the server's certificate (PEM); empty: those of the system. The certificate must be for the
  // address's host.
  static Result<Connection, base::Problem> open(const Address& address, const std::filesystem::path& ca);

  Result<void, base::Problem> send(std::string_view bytes);
  // Appends what arrives until `wait` is over, as soon as there is something. Errors: the connection has ended.
  Result<void, base::Problem> receive(std::string& to, std::chrono::milliseconds wait);
  [[nodiscard]] int descriptor() const noexcept { return socket_.get(); }

 private:
  struct FreeSsl {
    void operator()(SSL* ssl) const noexcept { SSL_free(ssl); }
  };
  Connection(base::Descriptor socket, std::unique_ptr<SSL, FreeSsl> tls)
      : socket_(std::move(socket)), tls_(std::move(tls)) {}
  // Returns the number of bytes; 0: `events` has what to wait for, negative: the connection has ended.
  long read_some(char* to, std::size_t most, short& events);
  long write_some(std::string_view bytes, short& events);

  base::Descriptor socket_;
  std::unique_ptr<SSL, FreeSsl> tls_;  // null: without TLS
};

// Connects to the address and closes the connection again. Returns why that is not possible.
Result<void, base::Problem> try_to_reach(const Address& address);

}  // namespace indurop::mqtt
