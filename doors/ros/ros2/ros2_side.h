// SPDX-License-Identifier: Apache-2.0
// The side of the program that is a node of ROS 2: an arm with its joint states and, if clients may move it, the topic
// joint_trajectory, the action follow_joint_trajectory and three services of its controller. For one thread.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "doors/ros/arm/ros_types.h"
#include "doors/ros/ros2/action.h"
#include "doors/ros/ros2/kinds.h"
#include "doors/ros/ros2/participant.h"
#include "doors/ros/ros2/service.h"
#include "network/dds/endpoint.h"
#include "network/dds/network_settings.h"

namespace indurop::ros {

class Ros2Side : public RosClients {
 public:
  // `space`: namespace of all names, such as "/cell"; empty: none.
  explicit Ros2Side(const std::string& space) : participant_(space, "indurop") {}

  // Returns a message for the user, or none. Errors: the network is not available now; the caller tries again.
  Result<std::string, base::Problem> join(const dds::NetworkSettings& settings) { return participant_.join(settings); }
  // After it has joined. `controller` empty: clients may not move the arm. Errors: DDS refuses.
  Result<void, base::Problem> add_arm(const std::string& controller, const std::string& urdf, RosEvents events);
  // Calls the events of what has arrived. Returns how many requests were ignored, because their clients use another
  // middleware of ROS 2.
  std::uint64_t spin();

  void publish_joints(const RosJoints& joints) override;
  void accept(int goal) override;
  void feedback(int goal, const RosFeedback& feedback) override;
  void finish(int goal, RosOutcome outcome, int code, const std::string& text) override;

 private:
  struct Power {
    RosService service;
    Service<TriggerRequest, TriggerReply> ends;
  };
  Result<void, base::Problem> add_controller(const std::string& controller);

  Ros2Participant participant_;
  RosEvents events_;
  dds::Endpoint joints_;
  dds::Endpoint description_;
  dds::Endpoint trajectories_;
  TrajectoryAction action_;
  std::vector<Power> power_;
};

}  // namespace indurop::ros
