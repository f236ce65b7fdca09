// SPDX-License-Identifier: Apache-2.0
// The points of a robot's files, for whoever looks at them and writes them beside the robot. Not real-time safe.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "robot/files.h"

namespace indurop::robot {

struct ListedPoint {
  std::string name;
  std::string place;  // "POSE 500 -200 350 RPY 180 0 180 IN pallet", as files have it
  std::string file;
  int line = 0;
};
struct ListedPoints {
  std::vector<ListedPoint> points;       // in the order of the files
  std::vector<std::string> frames;       // work frames, by name
  std::vector<base::Diagnostic> errors;  // of the files; without any, the others count
};
ListedPoints list_points(const FileNames& names);

// Where the robot stands.
struct Stand {
  std::vector<double> joints;           // deg, of sliding axes mm; at least as many as the arm has
  std::array<double, 3> position{};     // mm, of the tip in the base
  std::array<double, 3> orientation{};  // deg, roll pitch yaw
};

struct TeachOrder {
  std::string point;
  bool as_joint = false;  // neither: as the file has it, a new one as joint angles
  bool as_pose = false;
  std::string frame;  // as a pose in this work frame; empty: as the file has it
  std::string file;   // for a point that is new; empty: where most of the others are
};

struct TaughtPoint {
  std::vector<base::Diagnostic> errors;  // of the files; with any, nothing was changed
  std::string problem;                   // with the order, likewise
  ListedPoint now;
  std::string before;  // its place; empty: it is new
};
// Writes the point into the file that declares it, whole or not at all; what is around its place stays.
TaughtPoint teach_point(const FileNames& names, const TeachOrder& order, const Stand& stand);

}  // namespace indurop::robot
