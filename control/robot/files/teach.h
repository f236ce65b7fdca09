// SPDX-License-Identifier: Apache-2.0
// Lists and writes the points of a robot's files, for tools that run in addition to the robot. Not real-time safe.

#pragma once

#include <string>
#include <vector>

#include "control/robot/files/files.h"
#include "control/robot/files/stand.h"

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
  std::vector<base::Diagnostic> errors;  // of the files; if empty, the others are valid
};
ListedPoints list_points(const FileNames& names);

struct TeachOrder {
  std::string point;
  bool as_joint = false;  // if neither is set: as in the file; a new point as joint angles
  bool as_pose = false;
  std::string frame;  // as a pose in this work frame; empty: as in the file
  std::string file;   // for a new point; empty: the file with most of the other points
};

struct TaughtPoint {
  std::vector<base::Diagnostic> errors;  // of the files; if there are any, nothing was changed
  std::string problem;                   // with the request; if there is one, nothing was changed
  ListedPoint now;
  std::string before;  // its earlier place; empty: the point is new
};
// Writes the point into the file that declares it, completely or not at all; the text around its place is unchanged.
TaughtPoint teach_point(const FileNames& names, const TeachOrder& order, const Stand& stand);

}  // namespace indurop::robot
