// SPDX-License-Identifier: Apache-2.0
// TIME(), T_PLC_MS() and T_PLC_US(): the time of the schedule, which is constant during a scan. Its origin is the start
// of the computer, or that of the simulation. Real-time safe.

#pragma once

#include <indurop/irp.h>
#include <indurop/plc/types.h>

#include <cstdint>

namespace indurop::iec {

inline Time time() noexcept {
  return {irp::release_ns()};
}
// Wraps around after 49 days.
inline std::uint32_t t_plc_ms() noexcept {
  return static_cast<std::uint32_t>(irp::release_ns() / kMillisecond);
}
// Wraps around after 71 minutes.
inline std::uint32_t t_plc_us() noexcept {
  return static_cast<std::uint32_t>(irp::release_ns() / kMicrosecond);
}

// The same in any unit, as a number of any type; an integer wraps around.
template <Number T, std::int64_t unit_ns>
T ticks() noexcept {
  return static_cast<T>(irp::release_ns() / unit_ns);
}

}  // namespace indurop::iec
