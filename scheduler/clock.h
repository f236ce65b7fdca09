// SPDX-License-Identifier: Apache-2.0
// Where the scheduler takes its time from, so that tests and simulation can drive it with a virtual clock.

#pragma once

#include "rt/clock.h"

namespace indurop::scheduler {

class Clock {
 public:
  Clock() = default;
  virtual ~Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual rt::MonoTime now() noexcept = 0;                       // never runs backwards
  virtual void sleep_until(rt::MonoTime deadline) noexcept = 0;  // may return late, never early
};

// CLOCK_MONOTONIC.
class SystemClock final : public Clock {
 public:
  rt::MonoTime now() noexcept override;
  void sleep_until(rt::MonoTime deadline) noexcept override;
};

}  // namespace indurop::scheduler
