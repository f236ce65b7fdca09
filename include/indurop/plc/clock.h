// SPDX-License-Identifier: Apache-2.0
// TIME(), T_PLC_MS() and T_PLC_US(): the time of the schedule, which stands still during a scan. Its origin is the
// start of the computer, or that of the simulation. Real-time safe.

#pragma once

#include <indurop/irp.h>
#include <indurop/plc/types.h>

#include <cstdint>

namespace indurop::iec {

inline Time time() noexcept {
  return {irp::release_ns()};
}
// Goes around after 49 days.
inline std::uint32_t t_plc_ms() noexcept {
  return static_cast<std::uint32_t>(irp::release_ns() / kMillisecond);
}
// Goes around after 71 minutes.
inline std::uint32_t t_plc_us() noexcept {
  return static_cast<std::uint32_t>(irp::release_ns() / kMicrosecond);
}

}  // namespace indurop::iec
