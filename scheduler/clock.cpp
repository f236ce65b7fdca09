// SPDX-License-Identifier: Apache-2.0
#include "scheduler/clock.h"

#include "rt/clock.h"

namespace indurop::scheduler {

std::int64_t SystemClock::now() noexcept {
  return rt::now_ns();
}
void SystemClock::sleep_until(std::int64_t deadline_ns) noexcept {
  rt::sleep_until(deadline_ns);
}

}  // namespace indurop::scheduler
