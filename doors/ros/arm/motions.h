// SPDX-License-Identifier: Apache-2.0
// What clients want from one arm: trajectories as goals, one after the other, and streams of set points. Answers go to
// the client that asked. For one thread.

#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "doors/ros/arm/arm.h"
#include "doors/ros/arm/commands.h"
#include "doors/ros/arm/follower.h"
#include "doors/ros/arm/goal.h"
#include "doors/ros/arm/servo.h"
#include "doors/ros/model/joints.h"

namespace indurop::ros {

struct MotionEvents {
  std::function<void(int goal)> accepted;
  std::function<void(int goal, RosOutcome outcome, int code, const std::string& text)> ended;
  std::function<void(const std::string& text)> trouble;  // of what has no goal
};

class Motions {
 public:
  using Time = std::chrono::nanoseconds;  // monotonic

  // The joints have to be those of the arm. All are borrowed until the end.
  Motions(Arm& arm, Commands& commands, const std::vector<Joint>& joints, MotionEvents events);

  // A goal of a client. The one before it is cancelled, and this one begins when the arm stands.
  void want(int goal, const RosGoal& asked, Time now);
  void cancel(int goal);
  // Without a goal: no point stops the arm, one is a set point, more are a trajectory.
  void set_points(const RosGoal& asked, Time now);
  // Requests a service of the group: enable, disable, reset. Returns why it was not requested; empty: it was.
  std::string request(robot::Service service);
  // Returns how the service has ended, empty: well; nothing while it has not.
  [[nodiscard]] std::optional<std::string> service_end() const;
  // After the arm was read.
  void step(Time now);
  // The robot or this program is going: the arm comes to rest if it can hear that, and everything has ended.
  void abandon(const std::string& why);
  // The goal whose trajectory is followed; 0: none.
  [[nodiscard]] int active() const noexcept { return active_; }

 private:
  static constexpr int kNoGoal = 0;
  struct Wanted {
    int goal = kNoGoal;
    RosGoal asked;
    Time begin{0};
  };
  void begin(const Wanted& wanted, Time now);
  void end(int goal, RosOutcome outcome, GoalCode code, const std::string& text);
  // As that of the arm; or the robot has another number of axes than joints are known.
  [[nodiscard]] std::string obstacle(Arm::Locked locked) const;
  // Returns why the trajectory was not begun; empty: it was.
  GoalProblem try_to_begin(const RosGoal& asked, Time now);

  Arm* arm_;
  Commands* commands_;
  const std::vector<Joint>* joints_;
  MotionEvents events_;
  Follower follower_;
  Servo servo_;
  int active_ = kNoGoal;
  std::optional<Wanted> next_;
  std::string note_;  // on the trajectory that is followed
  Order service_;     // requested last
};

}  // namespace indurop::ros
