// SPDX-License-Identifier: Apache-2.0
// What other boards of the plant report tells when something went wrong there, so that this board's black box is kept,
// too: what it saw and did at that time belongs to it. No files here.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

class BoxWatch {
 public:
  // So many overruns of a node between two reports (half a second) are a fault.
  static constexpr std::uint64_t kManyOverruns = 10;

  // Why the box is to be kept; nothing if all is well, or is not known long enough to tell.
  std::optional<std::string> hear(const BoardReport& report);
  // Its agent left the network.
  std::optional<std::string> gone(const BoardReport& report);

 private:
  struct Known {
    std::uint64_t agent = 0;
    std::uint64_t faults = 0;
    std::uint64_t overruns = 0;
    std::uint64_t tick = 0;
    NodeCondition node = NodeCondition::None;
  };
  std::map<std::string, Known> known_;  // by board
};

}  // namespace indurop::deploy
