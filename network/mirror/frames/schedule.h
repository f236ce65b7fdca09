// SPDX-License-Identifier: Apache-2.0
// The start of a board's basic periods.

#pragma once

#include <chrono>

#include "core/rt/clock.h"

namespace indurop::mirror {

struct Schedule {
  rt::WallTime epoch{};  // wall time of tick 0; the clock's own epoch: no schedule runs
  std::chrono::nanoseconds basic{};
  std::chrono::nanoseconds macro{};
};

}  // namespace indurop::mirror
