// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/both_clocks.h"

#include <chrono>

namespace indurop::deploy {

BothClocks both_clocks() {
  constexpr int kTries = 10;
  constexpr std::chrono::microseconds kClose{20};
  BothClocks best;
  std::chrono::nanoseconds closest = std::chrono::hours(1);
  for (int i = 0; i < kTries && closest > kClose; ++i) {
    const rt::MonoTime before = rt::MonoClock::now();
    const rt::WallTime wall = rt::WallClock::now();
    if (const auto apart = rt::MonoClock::now() - before; apart < closest) {
      closest = apart;
      best = {before, wall};
    }
  }
  return best;
}

}  // namespace indurop::deploy
