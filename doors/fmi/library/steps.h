// SPDX-License-Identifier: Apache-2.0
// Which ticks lie in a communication step. Tick k is at START + k * basic period, and it lies in the step from T to T +
// H if it is at T or later and before T + H. A thousandth of a basic period does not count: masters add step sizes up.

#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

namespace indurop::fmi {

class Steps {
 public:
  Steps(std::chrono::nanoseconds basic_period, double start, std::optional<double> stop)
      : period_(std::chrono::duration<double>(basic_period).count()), start_(start), now_(start), stop_(stop) {}

  // Returns why a step from `at` of `size`, in seconds, is not possible; empty if it is.
  [[nodiscard]] std::string problem_of(double at, double size) const;
  // Returns how many ticks have run at its end, since the start. For a step that is possible.
  [[nodiscard]] std::uint64_t ticks_at_end(double at, double size) const {
    const double ticks = std::ceil((at + size - start_) / period_ - kTolerance);
    return ticks > 0 ? static_cast<std::uint64_t>(ticks) : 0;
  }
  void end_at(double time) { now_ = time; }
  [[nodiscard]] double now() const { return now_; }

 private:
  static constexpr double kTolerance = 1e-3;  // of a basic period
  static constexpr double kMostTicks = 1e15;  // so that a double tells them apart

  double period_;
  double start_;
  double now_;
  std::optional<double> stop_;
};

}  // namespace indurop::fmi
