// SPDX-License-Identifier: Apache-2.0
// The side of the program that is a node of ROS 1. Its source is the only one that knows roscpp, whose messages need
// C++17; so this header needs no more. For one thread, which is also that of all callbacks.

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "doors/ros/arm/ros_types.h"

namespace indurop::ros {

class RosSide : public RosClients {
 public:
  // `arguments`: those that roscpp takes, such as name:=other. Nothing is sent yet.
  RosSide(const std::string& name, const std::vector<std::string>& arguments);
  ~RosSide() override;

  // There is a master, and it is the one with which start() has registered.
  [[nodiscard]] bool has_master() const;
  [[nodiscard]] std::string master() const;
  void start();
  // Calls the events of what has arrived.
  void spin();

  // A topic of a variable, whose last value late subscribers get, too.
  std::size_t add_topic(const std::string& name, const std::string& type, const std::string& definition,
                        const std::string& md5);
  void remove_topics();
  void publish(std::size_t topic, const std::vector<std::uint8_t>& bytes);

  // The arm: joint_states and, if clients may move it, the action follow_joint_trajectory and the topic command of the
  // controller. `urdf` becomes the parameter robot_description if there is none.
  void add_arm(const std::string& controller, const std::string& urdf, bool may_move, RosEvents events);
  void publish_joints(const RosJoints& joints) override;
  void accept(int goal) override;
  void feedback(int goal, const RosFeedback& feedback) override;
  void finish(int goal, RosOutcome outcome, int code, const std::string& text) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace indurop::ros
