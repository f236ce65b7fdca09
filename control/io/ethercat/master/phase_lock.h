// SPDX-License-Identifier: Apache-2.0
// Keeps the tick in step with the reference clock of a bus: a controller with proportional and integral part, whose
// input is when the frame of the tick passed the reference clock, and whose output is how much longer or shorter the
// next period has to be. Real-time safe.

#pragma once

#include <cstdint>

namespace indurop::io::ethercat {

class PhaseLock {
 public:
  // `period_ns`: of the tick, by its own clock. Each period is changed by a thousandth at most.
  explicit PhaseLock(std::int64_t period_ns) noexcept : period_(period_ns) {}

  // The frame of this tick passed the reference clock at this time of its own, in ns. Returns the correction of the
  // next period in ns. The first call decides the phase that all later ones keep.
  std::int64_t step(std::int64_t reference_ns) noexcept;
  // The tick has no frame back: the clocks are assumed to differ as before.
  [[nodiscard]] std::int64_t coast() noexcept;

  // Reference time at which frames shall pass: any time at which the phase is 0.
  [[nodiscard]] std::int64_t grid_ns() const noexcept { return grid_; }
  [[nodiscard]] bool has_grid() const noexcept { return has_grid_; }
  // How late the last frame passed, in ns; below 0: early.
  [[nodiscard]] std::int64_t phase_ns() const noexcept { return phase_; }

 private:
  [[nodiscard]] std::int64_t limited() noexcept;

  std::int64_t period_;
  std::int64_t grid_ = 0;
  bool has_grid_ = false;
  std::int64_t phase_ = 0;
  double drift_ = 0;   // ns in a period by which frames would pass later and later
  double wanted_ = 0;  // correction, ns
  double rest_ = 0;    // of corrections, below 1 ns
};

}  // namespace indurop::io::ethercat
