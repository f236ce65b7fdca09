// SPDX-License-Identifier: Apache-2.0
// The master's side of a drive's touch probe (CiA 402, objects 60B8h to 60BBh): arms it anew and learns what it stored.

#pragma once

#include <indurop/robot/controller.h>

namespace indurop::robot {

class AxisProbe {
 public:
  // Waits for the next edge, `rising` or falling, of the probe's input or of the encoder's `mark`. What was stored
  // before does not count. Real-time safe, as all here.
  void begin(bool rising, bool mark) noexcept;
  // For the next one.
  void again() noexcept { step_ = Step::Clearing; }
  void stop() noexcept { step_ = Step::Idle; }

  // What the drive says. True: there was one, at counts().
  bool sense(const DriveIn& in) noexcept;
  [[nodiscard]] std::int32_t counts() const noexcept { return counts_; }
  // What the drive is told.
  [[nodiscard]] std::uint16_t function() const noexcept;

 private:
  enum class Step { Idle, Clearing, Armed };
  Step step_ = Step::Idle;
  bool rising_ = true;
  bool mark_ = false;
  std::int32_t counts_ = 0;
};

}  // namespace indurop::robot
