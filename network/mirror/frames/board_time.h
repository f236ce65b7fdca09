// SPDX-License-Identifier: Apache-2.0
// The time that a board's mirror uses: that of its node, which may be virtual.

#pragma once

#include "core/rt/clock.h"
#include "store/vars/store.h"

namespace indurop::mirror {

inline std::int64_t board_ns(const vars::Store& store) noexcept {
  return rt::to_ns(vars::time_of(store.header()));
}

// Wall-clock time for comparison with other boards. In virtual time all boards have one clock.
inline std::int64_t board_wall_ns(const vars::Store& store) noexcept {
  const std::int64_t simulated = store.header().virtual_ns.load(std::memory_order_relaxed);
  return simulated != 0 ? simulated : rt::wall_ns();
}

}  // namespace indurop::mirror
