// SPDX-License-Identifier: Apache-2.0
// What the two sides of the program exchange about the arm: rad and m, in the names of ROS. Plain C++17.

#pragma once

#include <string>
#include <vector>

namespace indurop::ros {

struct RosPoint {
  double time = 0;  // s from start
  std::vector<double> positions;
  std::vector<double> velocities;
};
struct RosTolerance {
  std::string name;
  double position = 0;
};
struct RosGoal {
  std::vector<std::string> names;
  std::vector<RosPoint> points;
  std::vector<RosTolerance> path;
  std::vector<RosTolerance> goal;
  double time_tolerance = 0;  // s
  double start_in = 0;        // s from now, by the stamp of the header; 0: at once
};

struct RosJoints {
  std::vector<std::string> names;
  std::vector<double> positions;
  std::vector<double> velocities;
  std::vector<double> efforts;  // empty: not known
};

struct RosFeedback {
  std::vector<std::string> names;
  std::vector<double> desired;
  std::vector<double> actual;
};

enum class RosService { Enable, Disable, Reset };
struct RosReply {
  bool done = false;
  std::string text;
};

enum class RosOutcome { Rejected, Succeeded, Aborted, Cancelled };

}  // namespace indurop::ros
