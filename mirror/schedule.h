// SPDX-License-Identifier: Apache-2.0
// When a board's basic periods begin.

#pragma once

#include <cstdint>

namespace indurop::mirror {

struct Schedule {
  std::int64_t epoch_wall_ns = 0;  // CLOCK_REALTIME of tick 0; 0: no schedule runs
  std::int64_t basic_ns = 0;
  std::int64_t macro_ns = 0;
};

}  // namespace indurop::mirror
