// SPDX-License-Identifier: Apache-2.0
// Messages of ROS 2 to and from what both programs of ROS exchange about an arm.

#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "doors/ros/arm/ros_types.h"
#include "doors/ros/ros2/kinds.h"

namespace indurop::ros {

using RosTime = builtin_interfaces_msg_dds__Time_;
RosTime ros_time(std::int64_t wall_ns) noexcept;
// An invalid one (nanoseconds of a second or more) is the nearest valid one.
std::int64_t ns_of(const RosTime& time) noexcept;

// The texts and sequences of a message, which lie here as long as it is written. What is given is borrowed.
class MessageMemory {
 public:
  static dds_sequence_double numbers(const std::vector<double>& from) noexcept;
  dds_sequence_string texts(const std::vector<std::string>& from);

 private:
  std::deque<std::vector<char*>> texts_;
};

// `now_ns`: by the wall clock, for the stamp of its header.
RosGoal goal_in(const TrajectoryMessage& message, std::int64_t now_ns);
RosGoal goal_in(const control_msgs_action_dds__FollowJointTrajectory_Goal_& message, std::int64_t now_ns);

// Both borrow what is given, also in `memory`.
JointStateMessage joint_state(const RosJoints& joints, std::int64_t now_ns, MessageMemory& memory);
// `error`: room for the differences.
control_msgs_action_dds__FollowJointTrajectory_Feedback_ feedback_message(const RosFeedback& feedback,
                                                                          std::int64_t now_ns, MessageMemory& memory,
                                                                          std::vector<double>& error);

}  // namespace indurop::ros
