// SPDX-License-Identifier: Apache-2.0
// End-to-end age of data along a chain of modules: from the release of the first module's run to the release of the
// last module's run that used its data. Each module reads when it begins and writes when it ends. Pure arithmetic.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/duration.h"

namespace indurop::config {

// The times of one periodic module of a board. The modules of a board are in order of execution.
struct Timed {
  base::Nanos period{};
  base::Nanos offset{};
  base::Nanos execution{};  // longest; 0: not known, counted as zero
  int core = 0;
};

struct ChainLink {
  std::size_t board = 0;
  std::size_t module = 0;  // index within the board
  base::Nanos every{};     // if its values leave the board: minimum time between two transmissions
};

// Time that a value takes from the store of one board to that of another.
struct NetworkShare {
  base::Nanos least{};
  base::Nanos most{};
};

struct ChainAge {
  base::Nanos least{};  // not negative: data released after a late start of the last module's run has age 0
  base::Nanos most{};
  std::size_t crossings = 0;  // transfers over the network
  bool exact = true;          // one board and one core: `most` can actually occur
};

// The boards' periods are not synchronized. Assumes that no module overruns; on several cores, that a module ends
// before its next release. `links` must not be empty.
ChainAge chain_age(std::span<const std::vector<Timed>> boards, std::span<const ChainLink> links,
                   const NetworkShare& network);

}  // namespace indurop::config
