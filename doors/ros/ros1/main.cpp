// SPDX-License-Identifier: Apache-2.0
// `indurop-ros1`: the variables and the arm of a node for programs of ROS 1.

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "core/base/exit_code.h"
#include "core/base/print.h"
#include "core/base/stop_signal.h"
#include "doors/ros/arm/arm_options.h"
#include "doors/ros/ros1/door.h"
#include "doors/ros/ros1/options.h"

namespace indurop::ros {
namespace {

constexpr const char* kDetails =
    R"(Publishes values when they have changed. Waits for the master and the node.
  indurop-ros1
  indurop-ros1 --variables 'PLC_ROBOT::*' --urdf robot.urdf
  indurop-ros1 --urdf robot.urdf --move
The master is that of ROS_MASTER_URI.
)";

int run(const Ros1Options& options) {
  base::StopSignal stop;
  auto arm = read_arm(options.arm, "indurop-ros1");
  if (!arm) {
    base::print(stderr, "{}", arm.error());
    return kUsage;
  }
  Ros1Door door(options, std::move(*arm));
  if (const auto done = door.run(stop); !done) {
    base::print(stderr, "indurop-ros1: error: {}\n", done.error().text);
    return kFailed;
  }
  constexpr int kSignalBase = 128;
  return kSignalBase + stop.received();
}

}  // namespace
}  // namespace indurop::ros

int main(int argc, char** argv) {
  using namespace indurop;
  base::Options app("indurop-ros1", "The variables and the arm of a node for ROS 1");
  app.version(INDUROP_VERSION);
  ros::Ros1Options options;
  ros::declare_options(app, options);
  app.details(ros::kDetails);
  app.exit_codes({kOk, kFailed, kUsage, kInterrupted, kTerminated});
  if (const auto code = app.parse_program(argc, argv)) {
    return *code;
  }
  return ros::run(options);
}
