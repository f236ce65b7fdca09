// SPDX-License-Identifier: Apache-2.0
// The messages of ROS 2 that the program exchanges: their types on the wire (ros2.idl), and their hashes in ROS 2
// jazzy, by which tools of ROS 2 tell versions of a message apart (REP 2011).

#pragma once

#include <indurop/idl/ros2.h>

#include "network/dds/entity.h"

namespace indurop::ros {

using TextMessage = std_msgs_msg_dds__String_;
using JointStateMessage = sensor_msgs_msg_dds__JointState_;
using TrajectoryMessage = trajectory_msgs_msg_dds__JointTrajectory_;
using FeedbackMessage = control_msgs_action_dds__FollowJointTrajectory_FeedbackMessage_;
using StatusMessage = action_msgs_msg_dds__GoalStatusArray_;
using SendGoalRequest = control_msgs_action_dds__FollowJointTrajectory_SendGoal_Request_;
using SendGoalReply = control_msgs_action_dds__FollowJointTrajectory_SendGoal_Response_;
using GetResultRequest = control_msgs_action_dds__FollowJointTrajectory_GetResult_Request_;
using GetResultReply = control_msgs_action_dds__FollowJointTrajectory_GetResult_Response_;
using CancelRequest = action_msgs_srv_dds__CancelGoal_Request_;
using CancelReply = action_msgs_srv_dds__CancelGoal_Response_;
using TriggerRequest = std_srvs_srv_dds__Trigger_Request_;
using TriggerReply = std_srvs_srv_dds__Trigger_Response_;
using DiscoveryMessage = rmw_dds_common_msg_dds__ParticipantEntitiesInfo_;

struct MessageKind {
  const dds::TypeDescriptor& type;
  const char* hash;
};
template <class Message>
MessageKind kind_of() noexcept;

template <>
inline MessageKind kind_of<TextMessage>() noexcept {
  return {std_msgs_msg_dds__String__desc, "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"};
}
template <>
inline MessageKind kind_of<JointStateMessage>() noexcept {
  return {sensor_msgs_msg_dds__JointState__desc,
          "RIHS01_a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e"};
}
template <>
inline MessageKind kind_of<TrajectoryMessage>() noexcept {
  return {trajectory_msgs_msg_dds__JointTrajectory__desc,
          "RIHS01_179b33eba59d676f6d967ac71fe35e7ca2f64b2f3928f4a018cec115e213796e"};
}
template <>
inline MessageKind kind_of<FeedbackMessage>() noexcept {
  return {control_msgs_action_dds__FollowJointTrajectory_FeedbackMessage__desc,
          "RIHS01_80398fcb9674a79081a9906e2ccf0c804dd7cb15e22e362e606ee87186beab71"};
}
template <>
inline MessageKind kind_of<StatusMessage>() noexcept {
  return {action_msgs_msg_dds__GoalStatusArray__desc,
          "RIHS01_6c1684b00f177d37438febe6e709fc4e2b0d4248dca4854946f9ed8b30cda83e"};
}
template <>
inline MessageKind kind_of<SendGoalRequest>() noexcept {
  return {control_msgs_action_dds__FollowJointTrajectory_SendGoal_Request__desc,
          "RIHS01_179c93691f1f6d1d115881ff88c3917b7cc6eac2ba4bf56766cc7c4389e19ef1"};
}
template <>
inline MessageKind kind_of<SendGoalReply>() noexcept {
  return {control_msgs_action_dds__FollowJointTrajectory_SendGoal_Response__desc,
          "RIHS01_e6a48ba740ae254500129a877f0b071be8663a115da1a539b74599cc97921fbf"};
}
template <>
inline MessageKind kind_of<GetResultRequest>() noexcept {
  return {control_msgs_action_dds__FollowJointTrajectory_GetResult_Request__desc,
          "RIHS01_ecf7ea8463d3beec7084bca75216d0b01b87b6e1e4e09679bb26093041efcbe9"};
}
template <>
inline MessageKind kind_of<GetResultReply>() noexcept {
  return {control_msgs_action_dds__FollowJointTrajectory_GetResult_Response__desc,
          "RIHS01_08eefbaa146ce02ba45898d5e99160afd6c4c54a30d159aee0f2ca6035b1580f"};
}
template <>
inline MessageKind kind_of<CancelRequest>() noexcept {
  return {action_msgs_srv_dds__CancelGoal_Request__desc,
          "RIHS01_3d3c84653c1f96918086887e1dcb236faec88b81a5b14fd4cf4840065bcdf8af"};
}
template <>
inline MessageKind kind_of<CancelReply>() noexcept {
  return {action_msgs_srv_dds__CancelGoal_Response__desc,
          "RIHS01_35e682cf3f510e83c70a82a4aac888496dedee56773bf9d8e5e0aa81f9e1c960"};
}
template <>
inline MessageKind kind_of<TriggerRequest>() noexcept {
  return {std_srvs_srv_dds__Trigger_Request__desc,
          "RIHS01_d010825374ce8918e72bfd826c82603e60f45419e932ea976f807b74a863a199"};
}
template <>
inline MessageKind kind_of<TriggerReply>() noexcept {
  return {std_srvs_srv_dds__Trigger_Response__desc,
          "RIHS01_2d946c21e2fc3f1e9ca6986a8191d85fcc70097a8bb7771a053564bc47009cdf"};
}
template <>
inline MessageKind kind_of<DiscoveryMessage>() noexcept {
  return {rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc,
          "RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e"};
}

}  // namespace indurop::ros
