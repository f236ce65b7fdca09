// SPDX-License-Identifier: Apache-2.0
// What indurop-pools has to do on a board of a plant, as its command line.

#pragma once

#include <string>
#include <vector>

#include "config/model/plant.h"

namespace indurop::config {

// A pool that a board sends or receives, as people read it: "sent to control and archive, at most every 100 ms".
struct BoardPool {
  std::string pool;  // as written in the manifest, in full after check_plant()
  std::string text;
  bool operator==(const BoardPool&) const = default;
};
// In the order of the manifest; empty: the board sends and receives none.
std::vector<BoardPool> pools_of(const Plant& plant, const std::string& board);

// Returns the arguments of indurop-pools on this board, without the program; empty if pools_of() is. `one_host`: all
// boards run on this host. Equal arguments mean that the program can go on.
std::vector<std::string> pool_arguments(const Plant& plant, const std::string& board, bool one_host);

}  // namespace indurop::config
