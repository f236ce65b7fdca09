// SPDX-License-Identifier: Apache-2.0
#include "network/dds/interface.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace indurop::dds {
namespace {

struct Card {
  std::string name;
  std::string address;
  bool up = false;
  bool loopback = false;
};

std::vector<Card> cards() {
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) {
    return {};
  }
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> all(first, &::freeifaddrs);
  std::vector<Card> found;
  for (const ifaddrs* at = first; at != nullptr; at = at->ifa_next) {
    if (at->ifa_addr == nullptr || at->ifa_addr->sa_family != AF_INET) {
      continue;
    }
    char text[INET_ADDRSTRLEN] = "";
    ::inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(at->ifa_addr)->sin_addr, text, sizeof text);
    found.push_back({at->ifa_name, text, (at->ifa_flags & IFF_UP) != 0, (at->ifa_flags & IFF_LOOPBACK) != 0});
  }
  return found;
}

}  // namespace

Result<Interface, base::Problem> choose_interface(const NetworkSettings& settings) {
  std::vector<Card> usable = cards();
  std::erase_if(usable, [](const Card& card) { return !card.up; });
  if (settings.one_host) {
    return Interface{"lo", {}};
  }
  if (!settings.interface_name.empty()) {
    if (std::none_of(usable.begin(), usable.end(), [&](const Card& c) { return c.name == settings.interface_name; })) {
      return base::Problem{
          fmt::format("network interface {} is missing, down or without an IPv4 address", settings.interface_name)};
    }
    return Interface{settings.interface_name, {}};
  }
  const auto own =
      std::find_if(usable.begin(), usable.end(), [&](const Card& card) { return card.address == settings.address; });
  if (own != usable.end()) {
    return Interface{own->name, {}};
  }
  std::erase_if(usable, [](const Card& card) { return card.loopback; });
  if (usable.empty()) {
    return base::Problem{"no network interface is up and has an IPv4 address"};
  }
  Interface chosen{usable.front().name, {}};
  if (usable.size() > 1) {
    std::string names;
    for (const Card& card : usable) {
      names += (names.empty() ? "" : ", ") + card.name;
    }
    chosen.note = fmt::format("{} was chosen from {}: name another one with interface= or address= of the board",
                              chosen.name, names);
  }
  return chosen;
}

}  // namespace indurop::dds
