// SPDX-License-Identifier: Apache-2.0
// Detects failures of other boards of the plant by their reports, so that this board's black box is kept too: it has
// this board's data of that time. No file access.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

class BoxWatch {
 public:
  // This many overruns of a node between two reports (half a second) are a fault.
  static constexpr std::uint64_t kManyOverruns = 10;

  // Returns why the black box is to be kept; nothing if all is well, or the board is not known long enough to judge.
  std::optional<std::string> note_report(const BoardReport& report);
  // The board's agent has left the network.
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
