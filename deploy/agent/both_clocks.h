// SPDX-License-Identifier: Apache-2.0
// Both clocks at the same moment: the tick of an exchange depends on it, and a thread may be preempted in between.

#pragma once

#include "core/rt/clock.h"

namespace indurop::deploy {

struct BothClocks {
  rt::MonoTime mono;
  rt::WallTime wall;
};
// Any thread. Tries a few times, for some microseconds each.
BothClocks both_clocks();

}  // namespace indurop::deploy
