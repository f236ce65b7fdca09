// SPDX-License-Identifier: Apache-2.0
// Follows one trajectory: sends it to the robot task, watches it, and says how it ended once the arm stands.

#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "doors/ros/arm/arm.h"
#include "doors/ros/arm/commands.h"
#include "doors/ros/arm/trajectory.h"

namespace indurop::ros {

// As FollowJointTrajectory numbers them.
enum class GoalCode : int {
  Successful = 0,
  InvalidGoal = -1,
  InvalidJoints = -2,
  OldHeader = -3,
  PathTolerance = -4,
  GoalTolerance = -5
};

struct GoalEnd {
  GoalCode code = GoalCode::Successful;
  bool cancelled = false;
  std::string text;
};

// Of each axis, degrees or mm; 0: none.
struct GoalTolerances {
  std::vector<double> path;          // between measured and commanded places
  std::vector<double> goal;          // at the end
  std::chrono::nanoseconds time{0};  // how long after the end of the trajectory the arm may need to be there
};

class Follower {
 public:
  using Time = std::chrono::nanoseconds;  // monotonic

  // Both are borrowed until the end.
  Follower(Arm& arm, Commands& commands) : arm_(&arm), commands_(&commands) {}

  // Sends the plan. Returns why it was not sent; empty: it was.
  std::string begin(const TrajectoryPlan& plan, const GoalTolerances& tolerances, Time now);
  // The arm comes to rest; step() tells when it stands.
  void cancel();
  // After the arm was read. Returns how the trajectory has ended, once.
  std::optional<GoalEnd> step(Time now);
  [[nodiscard]] bool is_busy() const noexcept { return phase_ != Phase::Idle; }

 private:
  enum class Phase { Idle, Moves, Settles, Stops };
  void halt();
  void end_with(GoalCode code, std::string text);
  void watch(Time now);
  [[nodiscard]] int beyond(const std::vector<double>& tolerances, bool at_goal) const;
  [[nodiscard]] std::optional<GoalEnd> settle(Time now);
  [[nodiscard]] bool has_stopped() const;

  Arm* arm_;
  Commands* commands_;
  Phase phase_ = Phase::Idle;
  std::vector<Order> orders_;
  std::vector<Order> halts_;
  bool is_halted_ = false;  // the halts were sent
  GoalTolerances tolerances_;
  std::vector<double> target_;
  Time settled_by_{0};
  GoalEnd end_;  // of Stops
};

}  // namespace indurop::ros
