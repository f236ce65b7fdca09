// SPDX-License-Identifier: Apache-2.0
// The order in which modules are executed. Checks, plans and the engine all use this function, so what is planned is
// what runs.

#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <numeric>
#include <vector>

namespace indurop::scheduler {

// Returns the indices 0 to count - 1 sorted by priority: the lowest value first, equal ones in input order. Not
// real-time safe.
template <std::invocable<std::uint32_t> PriorityOf>
std::vector<std::uint32_t> execution_order(std::size_t count, const PriorityOf& priority_of) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return priority_of(a) < priority_of(b); });
  return order;
}

}  // namespace indurop::scheduler
