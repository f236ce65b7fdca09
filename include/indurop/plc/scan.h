// SPDX-License-Identifier: Apache-2.0
// The information that a function block has about the scan in which it is called. Time comes from the schedule, not
// from a clock: it is constant during a scan, and in simulation and replay it is the time of the simulation.

#pragma once

#include <indurop/plc/arithmetic.h>
#include <indurop/plc/types.h>

namespace indurop::iec {

struct Scan {
  std::int64_t time_ns = 0;  // of the release, irp::release_ns(); from any origin, never backwards
};

namespace detail {

// Time since start(), as of the current scan.
class Stopwatch {
 public:
  void start(const Scan& scan) noexcept { start_ns_ = scan.time_ns; }
  // Continues as if it had started `elapsed` ago.
  void resume(const Scan& scan, Time elapsed) noexcept { start_ns_ = sub(scan.time_ns, elapsed.ns); }
  // Time before the start is ignored: a retained block may come from before the last boot.
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

// Inputs and outputs of the block have the values they had before the program ended: it resumes from there.
template <class Block>
void restore(Block& block, const Scan& scan) noexcept {
  if constexpr (requires { block.restore(scan); }) {
    block.restore(scan);
  }
}

}  // namespace indurop::iec
