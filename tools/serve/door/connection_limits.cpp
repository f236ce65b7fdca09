// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/door/connection_limits.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>

namespace indurop::serve {

std::string limits_key(const std::string& address) {
  constexpr std::size_t kNetworkBytes = 8;
  in6_addr bytes{};
  if (inet_pton(AF_INET6, address.c_str(), &bytes) != 1) {
    return address;
  }
  std::fill(std::begin(bytes.s6_addr) + kNetworkBytes, std::end(bytes.s6_addr), 0);
  std::array<char, INET6_ADDRSTRLEN> text{};
  return inet_ntop(AF_INET6, &bytes, text.data(), text.size()) != nullptr ? text.data() : address;
}

std::optional<ConnectionLimits::Id> ConnectionLimits::longest_waiting(const std::string* key) const {
  std::optional<Id> found;
  std::uint64_t since = 0;
  for (const auto& [id, one] : all_) {
    if (one.since != 0 && (key == nullptr || one.key == *key) && (!found || one.since < since)) {
      found = id;
      since = one.since;
    }
  }
  return found;
}

ConnectionLimits::Admission ConnectionLimits::admit(const std::string& address, bool loopback) {
  const std::string key = limits_key(address);
  const auto of_it = static_cast<std::size_t>(
      std::count_if(all_.begin(), all_.end(), [&key](const auto& one) { return one.second.key == key; }));
  const bool too_many_of_it = !loopback && of_it >= of_one_;
  Admission admission;
  if (too_many_of_it || all_.size() >= most_) {
    admission.instead = longest_waiting(too_many_of_it ? &key : nullptr);
    if (!admission.instead) {
      return admission;
    }
    all_.erase(*admission.instead);
  }
  admission.id = ++last_;
  all_[admission.id] = {key, ++clock_};
  return admission;
}

void ConnectionLimits::waiting(Id id) {
  if (const auto found = all_.find(id); found != all_.end()) {
    found->second.since = ++clock_;
  }
}

void ConnectionLimits::busy(Id id) {
  if (const auto found = all_.find(id); found != all_.end()) {
    found->second.since = 0;
  }
}

}  // namespace indurop::serve
