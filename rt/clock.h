// SPDX-License-Identifier: Apache-2.0
// The one time base of everything: CLOCK_MONOTONIC in nanoseconds. Real-time safe.

#pragma once

#include <ctime>

#include <cstdint>

namespace indurop::rt {

inline constexpr std::int64_t kNanosPerSecond = 1'000'000'000;

inline std::int64_t now_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kNanosPerSecond + now.tv_nsec;
}

// CLOCK_REALTIME: for stamps that another machine compares with its own; may jump.
inline std::int64_t wall_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * kNanosPerSecond + now.tv_nsec;
}

constexpr timespec to_timespec(std::int64_t ns) noexcept {
  return {ns / kNanosPerSecond, ns % kNanosPerSecond};
}

// Sleeps until the absolute time; signals do not shorten it. A time in the past returns at once.
void sleep_until(std::int64_t deadline_ns) noexcept;

}  // namespace indurop::rt
