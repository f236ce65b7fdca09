// SPDX-License-Identifier: Apache-2.0
// Statements that move the arm: motions, their offsets, and speed, zone and acceleration from here on.

#pragma once

#include "control/robot/job/statement.h"

namespace indurop::robot {

class MotionReader {
 public:
  MotionReader(const StatementParts& parts, const ArmShape& shape)
      : line_(parts.line), draft_(parts.draft), names_(parts.names), expressions_(parts.expressions), shape_(shape) {}

  void move(Move kind);
  // A line that has to find something on its way.
  void search();
  void spline();
  // A motion around obstacles.
  void free();
  void speed();
  void zone();
  void acceleration();

 private:
  // Each reads a setting into a step; nothing is added. Returns false if it is wrong.
  bool read_speed(Step& step);
  bool read_zone(Step& step);
  bool read_acceleration(Step& step);
  bool read_axis(const MotionExtras& extras, Step& step);
  void add(const Step& setting);
  bool amount(Step& step, const char* what);
  bool in_range(const Step& step, double low, double high, const JobToken& at, const char* wrong);
  void offset();
  void extras(std::size_t first_step);
  void until(MotionExtras& extras);
  void seed(MotionExtras& extras);
  void within(MotionExtras& extras);
  void sync(MotionExtras& extras);

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  ExpressionReader& expressions_;
  const ArmShape shape_;
};

}  // namespace indurop::robot
