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

// A place of a path along which the robot was guided.
struct GuidedPlace {
  std::vector<double> joints;  // as Stand::joints
  bool marked = false;         // a point that the robot passes exactly, at rest
};

struct PathOrder {
  std::string job;            // name of the job, and of its file without ".job"
  std::string file;           // where to write it; empty: job + ".job" next to the first file of jobs
  std::string tool;           // that was selected; empty: none
  double tolerance = 1;       // mm, of the tip
  double turn_tolerance = 1;  // deg
  double speed = 100;         // mm/s, of the job
};

struct TaughtPath {
  std::vector<base::Diagnostic> errors;  // of the files; if there are any, nothing was written
  std::string problem;                   // with the request; the same
  std::string file;                      // what was written
  std::string text;
  bool is_read = false;  // the robot's property jobs names it
  int points = 0;        // in the job
  double length = 0;     // mm of the path
  double deviation = 0;  // mm that the job deviates from it at most, and deg
  double turn_deviation = 0;
};
// Writes a job that follows a guided path, within the tolerance: MOVL where the tip went straight, MOVJ STRAIGHT where
// the axes did, else MOVS through as few points as that takes. A file that exists is only replaced if the robot reads
// it and it is empty or begins as the jobs that this function writes.
TaughtPath teach_path(const FileNames& names, const PathOrder& order, const std::vector<GuidedPlace>& path);

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
