// SPDX-License-Identifier: Apache-2.0
// A node of InduRoP for ROS 1: joins the side of the variables with that of roscpp. It waits for both, and begins again
// when the node ends or has other variables.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/base/problem.h"
#include "core/base/stop_signal.h"
#include "doors/ros/arm/arm_options.h"
#include "doors/ros/arm/served_arm.h"
#include "doors/ros/model/node.h"
#include "doors/ros/ros1/message.h"
#include "doors/ros/ros1/options.h"
#include "doors/ros/ros1/ros_side.h"

namespace indurop::ros {

class Ros1Door {
 public:
  Ros1Door(Ros1Options options, ArmFile arm);

  // Runs until a signal. Errors: the master has ended, the node has no such robot.
  Result<void, base::Problem> run(base::StopSignal& stop);

 private:
  using Time = std::chrono::nanoseconds;
  struct Topic {
    Variable variable;
    std::size_t number = 0;  // of RosSide
    std::vector<std::uint8_t> published;
  };
  // What lives as long as the node has its variables.
  struct Session {
    explicit Session(Node opened) : node(std::move(opened)) {}
    Node node;
    std::vector<Topic> topics;
  };

  Result<void, base::Problem> begin();
  void add_topics(Session& session);
  bool wait_for(base::StopSignal& stop, const std::string& what);
  void publish_values();
  void end(const std::string& why);

  Ros1Options options_;
  ServedArm::Choice choice_;
  std::string urdf_;
  base::Log log_;
  RosSide ros_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<ServedArm> arm_;  // of the session; null: none
  std::string waited_for_;
  Time next_{0};        // when values are published
  Time next_check_{0};  // of the master
};

}  // namespace indurop::ros
