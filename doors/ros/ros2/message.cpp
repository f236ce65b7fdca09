// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros2/message.h"

#include <algorithm>
#include <iterator>

#include "network/dds/lent.h"

namespace indurop::ros {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

std::vector<std::string> texts_in(const dds_sequence_string& from) {
  return {from._buffer, from._buffer + from._length};
}

std::vector<double> numbers_in(const dds_sequence_double& from) {
  return {from._buffer, from._buffer + from._length};
}

double seconds_in(const builtin_interfaces_msg_dds__Duration_& from) noexcept {
  return static_cast<double>(from.sec) + static_cast<double>(from.nanosec) / static_cast<double>(kSecond);
}

template <class Sequence>
std::vector<RosTolerance> tolerances_in(const Sequence& from) {
  std::vector<RosTolerance> tolerances;
  std::transform(from._buffer, from._buffer + from._length, std::back_inserter(tolerances),
                 [](const control_msgs_msg_dds__JointTolerance_& one) {
                   return RosTolerance{one.name, one.position};
                 });
  return tolerances;
}

std_msgs_msg_dds__Header_ header_at(std::int64_t now_ns) noexcept {
  static const std::string kNoFrame;
  return {ros_time(now_ns), dds::lent(kNoFrame)};
}

}  // namespace

RosTime ros_time(std::int64_t wall_ns) noexcept {
  return {static_cast<std::int32_t>(wall_ns / kSecond), static_cast<std::uint32_t>(wall_ns % kSecond)};
}

std::int64_t ns_of(const RosTime& time) noexcept {
  return time.sec * kSecond + std::min<std::int64_t>(time.nanosec, kSecond - 1);
}

dds_sequence_double MessageMemory::numbers(const std::vector<double>& from) noexcept {
  dds_sequence_double sequence{};
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(from.size());
  sequence._buffer = dds::lent(from.data());
  return sequence;
}

dds_sequence_string MessageMemory::texts(const std::vector<std::string>& from) {
  std::vector<char*>& pointers = texts_.emplace_back();
  std::transform(from.begin(), from.end(), std::back_inserter(pointers),
                 [](const std::string& one) { return dds::lent(one); });
  dds_sequence_string sequence{};
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(pointers.size());
  sequence._buffer = pointers.data();
  return sequence;
}

RosGoal goal_in(const TrajectoryMessage& message, std::int64_t now_ns) {
  RosGoal goal;
  goal.names = texts_in(message.joint_names);
  std::transform(
      message.points._buffer, message.points._buffer + message.points._length, std::back_inserter(goal.points),
      [](const trajectory_msgs_msg_dds__JointTrajectoryPoint_& point) {
        return RosPoint{seconds_in(point.time_from_start), numbers_in(point.positions), numbers_in(point.velocities)};
      });
  if (const std::int64_t stamp = ns_of(message.header.stamp); stamp != 0) {
    goal.start_in = static_cast<double>(stamp - now_ns) / static_cast<double>(kSecond);
  }
  return goal;
}

RosGoal goal_in(const control_msgs_action_dds__FollowJointTrajectory_Goal_& message, std::int64_t now_ns) {
  RosGoal goal = goal_in(message.trajectory, now_ns);
  goal.path = tolerances_in(message.path_tolerance);
  goal.goal = tolerances_in(message.goal_tolerance);
  goal.time_tolerance = seconds_in(message.goal_time_tolerance);
  return goal;
}

JointStateMessage joint_state(const RosJoints& joints, std::int64_t now_ns, MessageMemory& memory) {
  return {header_at(now_ns), memory.texts(joints.names), MessageMemory::numbers(joints.positions),
          MessageMemory::numbers(joints.velocities), MessageMemory::numbers(joints.efforts)};
}

control_msgs_action_dds__FollowJointTrajectory_Feedback_ feedback_message(const RosFeedback& feedback,
                                                                          std::int64_t now_ns, MessageMemory& memory,
                                                                          std::vector<double>& error) {
  error.resize(feedback.actual.size());
  std::transform(feedback.desired.begin(), feedback.desired.end(), feedback.actual.begin(), error.begin(),
                 [](double desired, double actual) { return desired - actual; });
  control_msgs_action_dds__FollowJointTrajectory_Feedback_ message{};
  message.header = header_at(now_ns);
  message.joint_names = memory.texts(feedback.names);
  message.desired.positions = MessageMemory::numbers(feedback.desired);
  message.actual.positions = MessageMemory::numbers(feedback.actual);
  message.error.positions = MessageMemory::numbers(error);
  return message;
}

}  // namespace indurop::ros
