// SPDX-License-Identifier: Apache-2.0
// The robot task of a node, as its variables show it (examples/robot_cell/plc_robot.glb): degrees and millimetres, axes
// from 0. For one thread.

#pragma once

#include <indurop/result.h>
#include <indurop/robot/words.h>

#include <string>
#include <vector>

#include "core/base/problem.h"
#include "doors/ros/model/node.h"

namespace indurop::ros {

struct AxisNow {
  robot::AxisState state = robot::AxisState::Disabled;
  double position = 0;  // measured
  double velocity = 0;  // measured
  double command = 0;   // commanded
  double torque = 0;    // N m, N; 0: not known
  double lower = 0;     // limits that apply now
  double upper = 0;
  double most_velocity = 0;
  double most_acceleration = 0;
  double most_jerk = 0;
};

class Arm {
 public:
  // `group`: namespace of its variables. Errors: the node has no robot of this name, or of another release.
  static Result<Arm, base::Problem> find(const Node& node, const std::string& group);

  // Reads everything again. False: the node has changed or ended.
  bool read();
  [[nodiscard]] std::size_t size() const noexcept { return axes_.size(); }
  [[nodiscard]] const AxisNow& axis(std::size_t number) const noexcept { return axes_[number]; }
  [[nodiscard]] const std::vector<AxisNow>& axes() const noexcept { return axes_; }
  // All axes are at rest, as commanded and in their own states.
  [[nodiscard]] bool stands() const noexcept;
  // Why nothing may be moved from outside now; empty: it may. A motion that is locked to time needs full override.
  enum class Locked : bool { No, ToTime };
  [[nodiscard]] std::string obstacle(Locked locked) const;

 private:
  Arm(Variable state, Variable axes, Variable arm, Variable speed, Variable hold);
  void read_axis(std::size_t number);

  Variable state_;
  Variable axis_states_;
  Variable arm_;
  Variable override_;
  Variable hold_;
  std::vector<AxisNow> axes_;
};

}  // namespace indurop::ros
