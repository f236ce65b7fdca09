// SPDX-License-Identifier: Apache-2.0
// What a function block knows of the scan it is called in. Time comes from the schedule, not from a clock: it stands
// still during a scan, and in simulation and replay it is the time of the simulation.

#pragma once

#include <indurop/plc/arithmetic.h>
#include <indurop/plc/types.h>

namespace indurop::iec {

struct Scan {
  std::int64_t time_ns = 0;  // of the release, irp::release_ns(); from any origin, never backwards
};

namespace detail {

// Time since start(), in scans.
class Stopwatch {
 public:
  void start(const Scan& scan) noexcept { start_ns_ = scan.time_ns; }
  // As if it had started that long ago.
  void resume(const Scan& scan, Time elapsed) noexcept { start_ns_ = sub(scan.time_ns, elapsed.ns); }
  // Time before the start does not count: a retained block may come from before the last boot.
  [[nodiscard]] Time elapsed(const Scan& scan) noexcept {
    if (scan.time_ns < start_ns_) {
      start(scan);
    }
    return {sub(scan.time_ns, start_ns_)};
  }

 private:
  std::int64_t start_ns_ = 0;
};

}  // namespace detail

// Inputs and outputs of the block have the values they had before the program ended: it goes on from there.
template <class Block>
void restore(Block& block, const Scan& scan) noexcept {
  if constexpr (requires { block.restore(scan); }) {
    block.restore(scan);
  }
}

}  // namespace indurop::iec
