// SPDX-License-Identifier: Apache-2.0
// Points as lines of job files: formats them, and inserts them into the text of a file.

#pragma once

#include <span>
#include <string>
#include <string_view>

#include "control/robot/job/job.h"
#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

// Formats a number as "12.5", "-0.001", never "-0", with at most this many decimals.
std::string decimal_text(double value, int decimals = 3);
// Converts the values of the arm's axes from deg (mm if they slide); there are at least as many as axes.
Joints joints_of_values(const Arm& arm, std::span<const double> values);
// Returns "JOINT 10 -20 30.5 0 90 0": the arm's axes in deg (mm if they slide), to a thousandth.
std::string joint_text(const Arm& arm, const Joints& joints);
// Returns "POSE 500 -200 350 RPY 180 0 180", in mm and deg, to a thousandth. `pose` is seen from the frame in which it
// is given.
std::string pose_text(const Pose& pose);
// A target with all that a point says of it, "POSE 500 -200 350 RPY 180 0 180 POSTURE 2 AXIS 7 90 IN pallet". `frame`:
// the one in which it is written; null: the base's.
std::string pose_text(const Arm& arm, const Target& target, const WorkFrame* frame);
// The same as written in the file.
std::string place_text(const JobBook& book, const Point& point, const Arm& arm);

// Transforms `pose` into coordinates of `frame`; both are given in the same frame.
Pose seen_from(const Pose& frame, const Pose& pose);

struct WithPoint {
  std::string text;
  int line = 0;  // where the point is written, from 1
};
// Returns the text with "POINT name = place" in line `line`, whose comment stays, or at the end if `line` is 0.
WithPoint put_point(std::string_view text, int line, std::string_view name, std::string_view place);
// The same with any statement.
WithPoint put_statement(std::string_view text, int line, std::string_view statement);
// Returns the statement in a line of the text, from 1, without its comment.
std::string_view statement_in(std::string_view text, int line);

}  // namespace indurop::robot
