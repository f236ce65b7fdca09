// SPDX-License-Identifier: Apache-2.0
// How values travel between periodic modules: who runs before whom, and how old a value can be. Pure arithmetic.

#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "config/model/config.h"

namespace indurop::config {

// A periodic module's releases, and its position in the order of execution within one basic period.
struct Release {
  base::Nanos period{};
  base::Nanos offset{};
  std::size_t position = 0;
};

// Time from the release of the last run of `writer` to the release of `reader`, over all releases of the reader.
struct Age {
  base::Nanos least{};
  base::Nanos most{};
  bool meet = false;           // both are released in some common basic period
  std::uint64_t meetings = 0;  // one of so many of the reader's releases, if they meet
};
Age age_between(const Release& writer, const Release& reader);

// Directed: values go from `first` to `second`; nodes are 0 .. count - 1.
using Edge = std::pair<std::size_t, std::size_t>;

// For each node a number of its group: nodes have the same one if values go round between them.
std::vector<std::size_t> circles(std::size_t count, const std::vector<Edge>& edges);

// All nodes such that each comes behind those it gets values from (within one circle: in the given order), otherwise as
// near as possible to 0 .. count - 1.
std::vector<std::size_t> writers_first(std::size_t count, const std::vector<Edge>& edges);

}  // namespace indurop::config
