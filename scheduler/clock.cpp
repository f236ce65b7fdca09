// SPDX-License-Identifier: Apache-2.0
#include "scheduler/clock.h"

namespace indurop::scheduler {

rt::MonoTime SystemClock::now() noexcept {
  return rt::MonoClock::now();
}
void SystemClock::sleep_until(rt::MonoTime deadline) noexcept {
  rt::sleep_until(deadline);
}

}  // namespace indurop::scheduler
