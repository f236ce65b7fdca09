// SPDX-License-Identifier: Apache-2.0
// The action control_msgs/action/FollowJointTrajectory on the wire: three services, and the topics of feedback and
// states. For one thread.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "doors/ros/arm/ros_types.h"
#include "doors/ros/ros2/goals.h"
#include "doors/ros/ros2/kinds.h"
#include "doors/ros/ros2/participant.h"
#include "doors/ros/ros2/service.h"

namespace indurop::ros {

class TrajectoryAction {
 public:
  using Time = std::chrono::nanoseconds;  // monotonic

  // `name`: of the action, without the namespace. `events` is borrowed until the end.
  Result<void, base::Problem> open(Ros2Participant& participant, const std::string& name, const RosEvents& events);
  // Answers what clients have asked.
  void spin(Time now);

  // Requests of other middlewares since the last call.
  std::uint64_t take_strangers() noexcept {
    return send_goal_.take_strangers() + cancel_.take_strangers() + get_result_.take_strangers();
  }

  void accept(int goal, Time now);
  void feedback(int goal, const RosFeedback& feedback);
  // The end of a goal, accepted or not.
  void finish(int goal, RosOutcome outcome, int code, const std::string& text, Time now);

 private:
  void take_goal(const SendGoalRequest& request, const Caller& caller, Time now);
  void take_cancel(const CancelRequest& request, const Caller& caller, Time now);
  void take_result_request(const GetResultRequest& request, const Caller& caller, Time now);
  void answer_goal(const Caller& caller, bool accepted, std::int64_t stamp_ns, Time now);
  void send_result(const Caller& caller, const Goal& goal, Time now);
  void publish_states();

  const RosEvents* events_ = nullptr;
  GoalBook goals_;
  std::map<int, Caller> asking_;         // goals that are not accepted yet
  std::multimap<int, Caller> awaiting_;  // results of goals
  Service<SendGoalRequest, SendGoalReply> send_goal_;
  Service<CancelRequest, CancelReply> cancel_;
  Service<GetResultRequest, GetResultReply> get_result_;
  dds::Endpoint feedback_;
  dds::Endpoint states_;
};

}  // namespace indurop::ros
