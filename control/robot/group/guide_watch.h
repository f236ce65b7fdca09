// SPDX-License-Identifier: Apache-2.0
// Decides whether what the drives measure may guide the arm: torques that are no number, more than a hand can push, the
// same for too long, or those of a weight that the arm does not know end guiding, since the arm would move on its own.

#pragma once

#include <array>

#include "control/robot/group/fault_text.h"
#include "control/robot/kinematics/dynamics.h"

namespace indurop::robot {

class GuideWatch {
 public:
  // What one period shows. Torques in N m, N of sliding axes.
  struct Seen {
    Joints push = Joints::Zero();           // of the hand: measured beyond what the arm needs
    Joints moving = Joints::Zero();         // the part of it that moves the axes
    std::array<std::int16_t, kAxes> raw{};  // as the drives report them
    Jacobian end = Jacobian::Zero();        // of the arm's end
  };

  // Guiding begins. Real-time safe, like all functions of this class.
  void begin() noexcept;
  // Takes a period. Errors: NoTorque (the torque of an axis cannot be right), Contact (weight); text() says why.
  [[nodiscard]] Fault step(const Seen& seen, int count, double period) noexcept;
  // Valid until the next step, as long as the object.
  [[nodiscard]] const char* text() const noexcept { return text_; }

 private:
  [[nodiscard]] Fault check_axis(const Seen& seen, int axis, double period) noexcept;
  [[nodiscard]] bool is_weight(const Seen& seen, int count, double period) noexcept;

  std::array<std::int16_t, kAxes> last_{};
  Joints same_ = Joints::Zero();  // s since the torque of each axis has changed
  double weight_ = 0;             // N, where the present run of about the same weight began
  double weighs_ = 0;             // s since then
  FaultText text_ = "";
};

}  // namespace indurop::robot
