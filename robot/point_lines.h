// SPDX-License-Identifier: Apache-2.0
// Points as lines of job files: written, and put where they belong in a file's text.

#pragma once

#include <string>
#include <string_view>

#include "robot/arm.h"
#include "robot/job.h"

namespace indurop::robot {

// "JOINT 10 -20 30.5 0 90 0" of the arm's axes, deg (mm where they slide), to a thousandth.
std::string joint_text(const Arm& arm, const Joints& joints);
// "POSE 500 -200 350 RPY 180 0 180" mm and deg, likewise. `pose` as it is seen from the frame it is given in.
std::string pose_text(const Pose& pose);
// The same as the file has it: in its frame.
std::string place_text(const JobBook& book, const Point& point, const Arm& arm);

// Where `pose` is, seen from `frame`; both seen from the same.
Pose seen_from(const Pose& frame, const Pose& pose);

struct WithPoint {
  std::string text;
  int line = 0;  // where the point stands, from 1
};
// The text with "POINT name = place" instead of what `line` says, whose comment stays, or at the end if it is 0.
WithPoint put_point(std::string_view text, int line, std::string_view name, std::string_view place);

}  // namespace indurop::robot
