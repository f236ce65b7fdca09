// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat_copies.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/check/io_mapping.h"

namespace indurop::io {

Result<std::vector<ethercat::Copy>, std::string> find_copies(std::span<const EthercatMember> members,
                                                             std::span<const ethercat::FoundSlave> found,
                                                             const EthercatPlaces& places) {
  std::vector<ethercat::Copy> copies;
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (const config::IoCopy& copy : members[i].slave.copies) {
      const auto source = std::find_if(members.begin(), members.end(),
                                       [&copy](const EthercatMember& other) { return other.device == copy.from; });
      const std::size_t from = places[static_cast<std::size_t>(source - members.begin())];
      const std::size_t to = places[i];
      if (const std::string wrong = config::problem_of_copy(copy, found[from].sii, found[to].sii); !wrong.empty()) {
        return fmt::format("{} ({}), device {}: {}", config::describe(members[i].slave), found[to].sii.name,
                           members[i].device, wrong);
      }
      const auto begin = ethercat::find_block(found[from].sii.inputs, config::block_of(copy.source));
      const auto end = ethercat::find_block(found[to].sii.outputs, config::block_of(copy.target));
      copies.push_back({from, begin->bit, to, end->bit, end->bits, copy.hold});
    }
  }
  return copies;
}

}  // namespace indurop::io
