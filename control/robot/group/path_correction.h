// SPDX-License-Identifier: Apache-2.0
// Shifts the path of a job by what a sensor measures, within the limits of the job and with the part of the joints'
// limits that planning leaves for it: by a distance, which changes only while the robot moves along its path, or until
// forces are reached, also at standstill.

#pragma once

#include <array>
#include <optional>

#include "control/robot/group/robot.h"
#include "control/robot/job/motion_port.h"

namespace indurop::robot {

class PathCorrection {
 public:
  // Part of the joints' speeds, accelerations and jerks that motions leave while their path is shifted. The shift alone
  // uses half of it: the rest is for joints that move in another way on the shifted path.
  static constexpr double kReserve = 0.3;

  explicit PathCorrection(Robot& robot) noexcept : robot_(robot) {}

  // Begins without a shift; the robot must be at standstill. Real-time safe, like all functions of this class.
  void begin(const CorrectionWay& way) noexcept;
  // Ends it: there is no shift any more.
  void end() noexcept;
  // How far to shift from now on, m along the axes.
  void want(const Vec3& shift) noexcept { wanted_ = shift; }
  // Part of its full speed that a tool that presses may have now, 0: it comes to rest.
  void set_pace(double part) noexcept { pace_ = part; }
  // What is missing to a tool that presses, in this period.
  void press(const PressNeeds& needs) noexcept { needs_ = needs; }
  // The arm no longer follows the path, but stands where it is. Its shift is kept for resume().
  void stand() noexcept;
  // The arm is where the path was left, with its shift.
  void resume() noexcept { shifts_ = on_; }

  // Returns whether set points may be off the path.
  [[nodiscard]] bool shifts() const noexcept { return shifts_; }
  // Returns whether the shift does not change.
  [[nodiscard]] bool at_rest() const noexcept;
  // Returns whether the shift may change while the path is at rest.
  [[nodiscard]] bool presses() const noexcept { return shifts_ && way_.directions() > 0; }
  // m/s by which the tip may be faster than on the path.
  [[nodiscard]] double speed() const noexcept;
  // The part of the joints' limits that the path may use, also in a stop.
  [[nodiscard]] double path_share() const noexcept { return shifts_ ? 1 - kReserve : 1; }

  // Shifts the set point of the path in this period. Errors: Unreachable, JointLimit, Singular, Torque.
  [[nodiscard]] Fault shift(Joints& q) noexcept;
  // Shifts a place of the path as far as resume() will. Returns false if the arm does not reach it.
  [[nodiscard]] bool shift_kept(Joints& q) const noexcept;

 private:
  static constexpr std::size_t kDirections = 3;
  [[nodiscard]] Mat3 axes_at(const Pose& tip) const noexcept;
  [[nodiscard]] bool shifted() const noexcept;
  void measure(std::size_t direction, const Joints& q) noexcept;
  [[nodiscard]] LineLimits limits_of(std::size_t direction) const noexcept;
  [[nodiscard]] Profile way_of(std::size_t direction, std::optional<double> to) const noexcept;
  [[nodiscard]] Profile way_of_press(std::size_t direction) noexcept;
  void move() noexcept;
  [[nodiscard]] Fault place(Joints& q) const noexcept;

  Robot& robot_;
  CorrectionWay way_;
  bool on_ = false;
  bool shifts_ = false;
  Vec3 wanted_ = Vec3::Zero();
  PressNeeds needs_;
  double pace_ = 1;
  // m, by what has been missing for a while, in each direction: a surface that moves away or comes.
  std::array<double, kDirections> lasting_{};
  double part_ = 1;  // of the limit and the rate, for each direction
  std::array<LineState, kDirections> shift_{};
  std::array<Joints, kDirections> rates_{};  // rad or m that each joint moves per m
  std::size_t next_ = 0;                     // direction that is measured next
};

}  // namespace indurop::robot
