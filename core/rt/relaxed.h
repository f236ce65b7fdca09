// SPDX-License-Identifier: Apache-2.0
// A short name for the order of counters and figures that other threads only read.

#pragma once

#include <atomic>

namespace indurop::rt {

inline constexpr auto kRelaxed = std::memory_order_relaxed;

}  // namespace indurop::rt
