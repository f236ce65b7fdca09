// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/serve/address.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/base/text.h"

namespace indurop::mqtt {

bool Address::is_loopback() const {
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

std::string Address::host_and_port() const {
  const bool is_ipv6 = host.find(':') != std::string::npos;
  return fmt::format("{}{}{}:{}", is_ipv6 ? "[" : "", host, is_ipv6 ? "]" : "", port);
}

Result<Address, base::Problem> read_address(std::string_view text, const Schemes& schemes) {
  const base::Problem wrong{fmt::format("{} is no address such as {}://127.0.0.1:{}", base::in_quotes(text),
                                        schemes.plain, schemes.plain_port)};
  const auto end_of_scheme = text.find("://");
  if (end_of_scheme == std::string_view::npos) {
    return wrong;
  }
  const std::string_view scheme = text.substr(0, end_of_scheme);
  std::string_view rest = text.substr(end_of_scheme + 3);
  Address address;
  address.tls = scheme == schemes.tls;
  if (!address.tls && scheme != schemes.plain) {
    return wrong;
  }
  if (rest.ends_with('/')) {
    rest.remove_suffix(1);
  }
  const bool brackets = rest.starts_with('[');
  const auto end_of_host = brackets ? rest.find(']') : rest.find(':');
  if (brackets && end_of_host == std::string_view::npos) {
    return wrong;
  }
  address.host = rest.substr(brackets ? 1 : 0, end_of_host - (brackets ? 1 : 0));
  rest.remove_prefix(std::min(rest.size(), brackets ? end_of_host + 1 : end_of_host));
  address.port = address.tls ? schemes.tls_port : schemes.plain_port;
  if (!rest.empty()) {
    const auto parsed = std::from_chars(rest.data() + 1, rest.data() + rest.size(), address.port);
    if (rest.front() != ':' || parsed.ec != std::errc() || parsed.ptr != rest.data() + rest.size()) {
      return wrong;
    }
  }
  if (address.host.empty() || address.host.find_first_of("/@?# ") != std::string::npos) {
    return wrong;
  }
  return address;
}

}  // namespace indurop::mqtt
