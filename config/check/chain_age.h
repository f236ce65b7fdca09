// SPDX-License-Identifier: Apache-2.0
// How old what a chain of modules hands on is at its end: from the release of the first one's run to the release of the
// last one's run that used it. Each reads when it begins and writes when it ends. Pure arithmetic.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/duration.h"

namespace indurop::config {

// A periodic module of a board, which has them in order of execution.
struct Timed {
  base::Nanos period{};
  base::Nanos offset{};
  base::Nanos execution{};  // longest; 0: not known, counted as no time
  int core = 0;
};

struct ChainLink {
  std::size_t board = 0;
  std::size_t module = 0;  // of the board
  base::Nanos every{};     // if its values leave the board: at most this often
};

// From a board's store to another's.
struct NetworkShare {
  base::Nanos least{};
  base::Nanos most{};
};

struct ChainAge {
  base::Nanos least{};  // not negative: what is released after the last one's run, which begins late, is not old at all
  base::Nanos most{};
  std::size_t crossings = 0;  // ways through the network
  bool exact = true;          // one board and one core: `most` is reached
};

// Boards begin their periods whenever they like. Nobody overruns; on several cores a module ends before its next
// release. `links` are not empty.
ChainAge chain_age(std::span<const std::vector<Timed>> boards, std::span<const ChainLink> links,
                   const NetworkShare& network);

}  // namespace indurop::config
