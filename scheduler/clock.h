// SPDX-License-Identifier: Apache-2.0
// Where the scheduler takes its time from, so that tests and simulation can drive it with a virtual clock.

#pragma once

#include <cstdint>

namespace indurop::scheduler {

class Clock {
 public:
  Clock() = default;
  virtual ~Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual std::int64_t now() noexcept = 0;                          // ns, never runs backwards
  virtual void sleep_until(std::int64_t deadline_ns) noexcept = 0;  // may return late, never early
};

// CLOCK_MONOTONIC.
class SystemClock final : public Clock {
 public:
  std::int64_t now() noexcept override;
  void sleep_until(std::int64_t deadline_ns) noexcept override;
};

}  // namespace indurop::scheduler
