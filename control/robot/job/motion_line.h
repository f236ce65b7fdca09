// SPDX-License-Identifier: Apache-2.0
// The job and the line of a motion, in one number that goes with the motion (MoveCommand::source).

#pragma once

#include <cstdint>

namespace indurop::robot {

struct MotionLine {
  int job = -1;  // -1: none
  std::uint32_t line = 0;

  // `source` is above 0.
  static MotionLine of(int source) noexcept {
    return {source >> kLineBits, static_cast<std::uint32_t>(source) & ((1U << kLineBits) - 1)};
  }
  [[nodiscard]] int source() const noexcept { return job << kLineBits | static_cast<int>(line); }

 private:
  static constexpr int kLineBits = 20;
};

}  // namespace indurop::robot
