// SPDX-License-Identifier: Apache-2.0
// When a board's basic periods begin.

#pragma once

#include <chrono>

#include "rt/clock.h"

namespace indurop::mirror {

struct Schedule {
  rt::WallTime epoch{};  // of tick 0; that of the clock itself: no schedule runs
  std::chrono::nanoseconds basic{};
  std::chrono::nanoseconds macro{};
};

}  // namespace indurop::mirror
