// SPDX-License-Identifier: Apache-2.0
// A node of InduRoP for ROS 1: joins the side of the variables with that of roscpp. It waits for both, and begins again
// when the node ends or has other variables.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/base/problem.h"
#include "core/base/stop_signal.h"
#include "doors/ros/arm/motions.h"
#include "doors/ros/model/joints.h"
#include "doors/ros/model/node.h"
#include "doors/ros/ros1/message.h"
#include "doors/ros/ros1/options.h"
#include "doors/ros/ros1/ros_side.h"

namespace indurop::ros {

class Ros1Door {
 public:
  // `joints` of the file `urdf_text`, none without an arm.
  Ros1Door(Ros1Options options, std::vector<Joint> joints, std::string urdf_text);

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
    std::optional<Arm> arm;
    std::optional<Commands> commands;
    std::optional<Motions> motions;
  };

  Result<void, base::Problem> begin();
  Result<void, base::Problem> find_arm(Session& session);
  void add_topics(Session& session);
  bool wait_for(base::StopSignal& stop, const std::string& what);
  void serve_arm(Time now, bool is_due);
  RosReply run_service(RosService service);
  void publish_values();
  void publish_joints(const Arm& arm);
  [[nodiscard]] RosEvents ros_events();
  [[nodiscard]] MotionEvents motion_events();

  Ros1Options options_;
  std::vector<Joint> joints_;
  std::string urdf_text_;
  base::Log log_;
  RosSide ros_;
  std::unique_ptr<Session> session_;
  std::string waited_for_;
  Time next_{0};  // when values are published
  Time next_feedback_{0};
  Time next_check_{0};  // of the master
};

}  // namespace indurop::ros
