// SPDX-License-Identifier: Apache-2.0
// Addresses of servers as users write them: "https://desk:8080", "mqtt://[::1]".

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/problem.h"

namespace indurop::mqtt {

struct Address {
  bool tls = false;
  std::string host;  // without the brackets of IPv6
  std::uint16_t port = 0;
  // Returns true if the address is that of this machine, whatever names resolve to.
  [[nodiscard]] bool is_loopback() const;
  // "desk:8080", "[::1]:8080".
  [[nodiscard]] std::string host_and_port() const;
};

// A scheme without and with TLS, and the ports if the address names none.
struct Schemes {
  std::string_view plain;
  std::string_view tls;
  std::uint16_t plain_port;
  std::uint16_t tls_port;
};
inline constexpr Schemes kHttp{"http", "https", 80, 443};
inline constexpr Schemes kMqtt{"mqtt", "mqtts", 1883, 8883};

// Errors: it is no such address; the message has an example.
Result<Address, base::Problem> read_address(std::string_view text, const Schemes& schemes);

}  // namespace indurop::mqtt
