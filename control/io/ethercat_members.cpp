// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat_members.h"

#include <fmt/format.h>

#include <algorithm>

namespace indurop::io {
namespace {

// Where the slave of a device is, or what is wrong.
Result<std::size_t, std::string> find(const EthercatMember& member, std::span<const ethercat::FoundSlave> found,
                                      const std::string& interface) {
  auto place = static_cast<std::size_t>(member.slave.position);
  if (member.slave.alias) {
    const auto has_alias = [&member](const ethercat::FoundSlave& slave) { return slave.alias == *member.slave.alias; };
    const auto first = std::find_if(found.begin(), found.end(), has_alias);
    place = static_cast<std::size_t>(first - found.begin());
    if (first != found.end() && std::any_of(first + 1, found.end(), has_alias)) {
      return fmt::format("device {} is {}, and several have it; give each an alias of its own", member.device,
                         config::describe(member.slave));
    }
  }
  if (place >= found.size()) {
    return fmt::format(
        "device {} is {}, and {} answer, {}", member.device, config::describe(member.slave), found.size(),
        member.slave.alias ? "none of them with it; `indurop io scan` shows their aliases"
                           : "from 0 on; check the cable after the last one, or the position in the file");
  }
  const ethercat::Identity& identity = found[place].sii.identity;
  const auto differs = [](const std::optional<std::uint32_t>& wanted, std::uint32_t is) {
    return wanted && *wanted != is;
  };
  if (differs(member.slave.vendor, identity.vendor) || differs(member.slave.product, identity.product) ||
      differs(member.slave.revision, identity.revision)) {
    return fmt::format(
        "slave {}, device {}: it is {}, vendor 0x{:x}, product 0x{:x}, revision 0x{:x}, and the file "
        "says another one; `indurop io scan {}` shows what is there",
        place, member.device, found[place].sii.name, identity.vendor, identity.product, identity.revision, interface);
  }
  return place;
}

}  // namespace

Result<EthercatPlaces, std::string> find_members(std::span<const EthercatMember> members,
                                                 std::span<const ethercat::FoundSlave> found,
                                                 const std::string& interface) {
  EthercatPlaces places;
  for (const EthercatMember& member : members) {
    const auto place = find(member, found, interface);
    if (!place) {
      return place.error();
    }
    const auto other = std::find(places.begin(), places.end(), *place);
    if (other != places.end()) {
      return fmt::format("device {} is {}, which is slave {}, as device {}; move the points of one to the other",
                         member.device, config::describe(member.slave), *place,
                         members[static_cast<std::size_t>(other - places.begin())].device);
    }
    places.push_back(*place);
  }
  return places;
}

}  // namespace indurop::io
