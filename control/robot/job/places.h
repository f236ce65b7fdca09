// SPDX-License-Identifier: Apache-2.0
// Statements that declare places: points and work frames.

#pragma once

#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "control/robot/job/statement.h"

namespace indurop::robot {

class PlaceReader {
 public:
  PlaceReader(const StatementParts& parts, const ArmShape& shape)
      : line_(parts.line), draft_(parts.draft), names_(parts.names), shape_(shape) {}

  void point();
  void frame();

 private:
  void frame_points();
  void matched_points(WorkFrame& frame);
  void joint_point(Target& target);
  void pose_point(Target& target);
  void posture(Target& target);
  void held_axis(Target& target);
  [[nodiscard]] double axis_value(int axis, double written) const noexcept;

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  const ArmShape shape_;
  std::map<std::string, std::string, std::less<>> point_places_;  // file and line, by name
  std::set<std::string> frames_;                                  // names
  std::array<int, kAxes> axis_columns_{};                         // Point::axis_columns of the point that is read
};

}  // namespace indurop::robot
