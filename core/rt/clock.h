// SPDX-License-Identifier: Apache-2.0
// The common time base: CLOCK_MONOTONIC in nanoseconds; in addition CLOCK_REALTIME for time stamps that another machine
// compares with its own. Two types, so that neither is mistaken for the other. Real-time safe.

#pragma once

#include <ctime>

#include <chrono>
#include <cstdint>

namespace indurop::rt {

inline constexpr std::int64_t kNanosPerSecond = 1'000'000'000;

// A clock of the system as one of std::chrono. The clock is the tag of its times: times of two clocks do not mix.
template <clockid_t kId, bool kSteady>
struct SystemTime {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<SystemTime>;
  static constexpr bool is_steady = kSteady;
  static time_point now() noexcept {
    timespec now{};
    ::clock_gettime(kId, &now);
    return time_point{duration{now.tv_sec * kNanosPerSecond + now.tv_nsec}};
  }
};

// Its epoch is the start of the machine.
using MonoClock = SystemTime<CLOCK_MONOTONIC, true>;
using MonoTime = MonoClock::time_point;

// Its epoch is 1970: for time stamps that another machine compares with its own; may jump.
using WallClock = SystemTime<CLOCK_REALTIME, false>;
using WallTime = WallClock::time_point;

// Conversion to and from the plain numbers of shared memory and of the network: nanoseconds since the clock's epoch.
constexpr MonoTime mono_time(std::int64_t ns) noexcept {
  return MonoTime{std::chrono::nanoseconds{ns}};
}
constexpr WallTime wall_time(std::int64_t ns) noexcept {
  return WallTime{std::chrono::nanoseconds{ns}};
}
template <clockid_t kId, bool kSteady>
constexpr std::int64_t to_ns(std::chrono::time_point<SystemTime<kId, kSteady>> time) noexcept {
  return time.time_since_epoch().count();
}

// The present time as a plain number.
inline std::int64_t now_ns() noexcept {
  return to_ns(MonoClock::now());
}
inline std::int64_t wall_ns() noexcept {
  return to_ns(WallClock::now());
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
