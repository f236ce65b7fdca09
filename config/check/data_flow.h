// SPDX-License-Identifier: Apache-2.0
// The flow of values between periodic modules: the order of execution, and how old a value can be. Pure arithmetic.

#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "config/model/config.h"

namespace indurop::config {

// The releases of a periodic module, and its position in the order of execution within one basic period.
struct Release {
  base::Nanos period{};
  base::Nanos offset{};
  std::size_t position = 0;
};

// Time from the release of the last run of `writer` to the release of `reader`: minimum and maximum over all releases
// of the reader.
struct Age {
  base::Nanos least{};
  base::Nanos most{};
  bool meet = false;           // both are released together in at least one basic period
  std::uint64_t meetings = 0;  // if they meet: in one out of this many releases of the reader
};
Age age_between(const Release& writer, const Release& reader);

// A directed edge: values go from `first` to `second`; nodes are 0 .. count - 1.
using Edge = std::pair<std::size_t, std::size_t>;

// Returns a group number for each node: nodes on a common cycle have the same one.
std::vector<std::size_t> circles(std::size_t count, const std::vector<Edge>& edges);

// Returns all nodes so that each comes after those it gets values from (within a cycle: in the given order), otherwise
// as close as possible to 0 .. count - 1.
std::vector<std::size_t> writers_first(std::size_t count, const std::vector<Edge>& edges);

}  // namespace indurop::config
