// SPDX-License-Identifier: Apache-2.0
// The one time base of everything: CLOCK_MONOTONIC in nanoseconds; beside it CLOCK_REALTIME for stamps that another
// machine compares with its own. Two types, so that neither is taken for the other. Real-time safe.

#pragma once

#include <ctime>

#include <chrono>
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

// CLOCK_MONOTONIC as a clock of std::chrono; its epoch is the start of the machine.
struct MonoClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<MonoClock>;
  static constexpr bool is_steady = true;
  static time_point now() noexcept { return time_point{duration{now_ns()}}; }
};
using MonoTime = MonoClock::time_point;

// CLOCK_REALTIME likewise; its epoch is 1970.
struct WallClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<WallClock>;
  static constexpr bool is_steady = false;
  static time_point now() noexcept { return time_point{duration{wall_ns()}}; }
};
using WallTime = WallClock::time_point;

// To and from the plain numbers of shared memory and of the wire: nanoseconds since the clock's epoch.
constexpr MonoTime mono_time(std::int64_t ns) noexcept {
  return MonoTime{std::chrono::nanoseconds{ns}};
}
constexpr WallTime wall_time(std::int64_t ns) noexcept {
  return WallTime{std::chrono::nanoseconds{ns}};
}
constexpr std::int64_t to_ns(MonoTime time) noexcept {
  return time.time_since_epoch().count();
}
constexpr std::int64_t to_ns(WallTime time) noexcept {
  return time.time_since_epoch().count();
}

constexpr timespec to_timespec(std::int64_t ns) noexcept {
  return {ns / kNanosPerSecond, ns % kNanosPerSecond};
}

// Sleeps until the absolute time; signals do not shorten it. A time in the past returns at once.
void sleep_until(std::int64_t deadline_ns) noexcept;
inline void sleep_until(MonoTime deadline) noexcept {
  sleep_until(to_ns(deadline));
}

}  // namespace indurop::rt
