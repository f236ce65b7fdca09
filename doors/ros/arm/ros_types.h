// SPDX-License-Identifier: Apache-2.0
// What the two sides of the program exchange about the arm: rad and m, in the names of ROS. Plain C++17.

#pragma once

#include <functional>
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

// What clients want. Goals have numbers, from 1.
struct RosEvents {
  std::function<void(int goal, const RosGoal& asked)> goal;
  std::function<void(int goal)> cancel;
  std::function<void(const RosGoal& asked)> set_points;  // of the controller's topic
  std::function<RosReply(RosService service)> service;
};

// The clients of an arm, as a program of ROS reaches them.
class RosClients {
 public:
  RosClients() = default;
  RosClients(const RosClients&) = delete;
  RosClients& operator=(const RosClients&) = delete;
  virtual ~RosClients() = default;

  virtual void publish_joints(const RosJoints& joints) = 0;
  virtual void accept(int goal) = 0;
  virtual void feedback(int goal, const RosFeedback& feedback) = 0;
  // The end of a goal, accepted or not.
  virtual void finish(int goal, RosOutcome outcome, int code, const std::string& text) = 0;
};

}  // namespace indurop::ros
