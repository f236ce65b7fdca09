// SPDX-License-Identifier: Apache-2.0
// The master's side of a drive's touch probe (CiA 402, objects 60B8h to 60BBh): arms it again and reads the stored
// position.

#pragma once

#include <indurop/robot/controller.h>

namespace indurop::robot {

class AxisProbe {
 public:
  // Waits for the next edge, `rising` or falling, of the probe's input or of the encoder's `mark`. Positions stored
  // before are ignored. All functions of this class are real-time safe.
  void begin(bool rising, bool mark) noexcept;
  // Waits for the next edge again.
  void again() noexcept { step_ = Step::Clearing; }
  void stop() noexcept { step_ = Step::Idle; }

  // Reads the drive's status. Returns true if there was an edge, at counts().
  bool sense(const DriveIn& in) noexcept;
  [[nodiscard]] std::int32_t counts() const noexcept { return counts_; }
  // Returns the touch probe function for the drive.
  [[nodiscard]] std::uint16_t function() const noexcept;

 private:
  enum class Step { Idle, Clearing, Armed };
  Step step_ = Step::Idle;
  bool rising_ = true;
  bool mark_ = false;
  std::int32_t counts_ = 0;
};

}  // namespace indurop::robot
