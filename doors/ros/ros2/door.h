// SPDX-License-Identifier: Apache-2.0
// The arm of a node of InduRoP for ROS 2: joins the side of the variables with that of DDS. It waits for both, and
// begins again when the node ends or has other variables.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/base/log.h"
#include "core/base/problem.h"
#include "core/base/stop_signal.h"
#include "doors/ros/arm/arm_options.h"
#include "doors/ros/arm/served_arm.h"
#include "doors/ros/model/node.h"
#include "doors/ros/ros2/options.h"
#include "doors/ros/ros2/ros2_side.h"

namespace indurop::ros {

class Ros2Door {
 public:
  Ros2Door(Ros2Options options, ArmFile arm);

  // Runs until a signal. Errors: DDS refuses a topic.
  Result<void, base::Problem> run(base::StopSignal& stop);

 private:
  using Time = std::chrono::nanoseconds;

  // Returns false after a signal.
  bool join(base::StopSignal& stop);
  bool wait_for(base::StopSignal& stop, const std::string& what);
  Result<void, base::Problem> begin();
  void serve(Time now);
  void end(const std::string& why);
  void report_unreadable(Time now);

  Ros2Options options_;
  ServedArm::Choice choice_;
  std::string urdf_;
  base::Log log_;
  Ros2Side ros_;
  std::optional<Node> node_;
  std::unique_ptr<ServedArm> arm_;  // of the node; null: none
  std::string waited_for_;
  Time next_{0};  // when joint states are published
  Time next_report_{0};
  std::uint64_t unreadable_ = 0;  // messages, as reported
};

}  // namespace indurop::ros
