// SPDX-License-Identifier: Apache-2.0
// `indurop-ros2`: the arm of a node for programs of ROS 2.

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "core/base/exit_code.h"
#include "core/base/print.h"
#include "core/base/stop_signal.h"
#include "doors/ros/arm/arm_options.h"
#include "doors/ros/ros2/door.h"
#include "doors/ros/ros2/options.h"

namespace indurop::ros {
namespace {

constexpr const char* kDetails =
    R"(The arm of a node for programs of ROS 2. Waits for the network and the node. Variables are topics
of the node itself, see <external ros2="on">.
  indurop-ros2 --urdf robot.urdf
  indurop-ros2 --urdf robot.urdf --move --interface lo
)";

int fail_with(const std::string& text, int code) {
  base::print(stderr, "{}", text);
  return code;
}

int run(const Ros2Options& options) {
  base::StopSignal stop;
  if (options.arm.urdf.empty()) {
    return fail_with("indurop-ros2: error: --urdf FILE is needed; it has the joints of the arm\n", kUsage);
  }
  auto arm = read_arm(options.arm, "indurop-ros2");
  if (!arm) {
    return fail_with(arm.error(), kUsage);
  }
  Ros2Door door(options, std::move(*arm));
  if (const auto done = door.run(stop); !done) {
    return fail_with(fmt::format("indurop-ros2: error: {}\n", done.error().text), kFailed);
  }
  constexpr int kSignalBase = 128;
  return kSignalBase + stop.received();
}

}  // namespace
}  // namespace indurop::ros

int main(int argc, char** argv) {
  using namespace indurop;
  base::Options app("indurop-ros2", "The arm of a node for ROS 2");
  app.version(INDUROP_VERSION);
  ros::Ros2Options options;
  ros::declare_options(app, options);
  app.details(ros::kDetails);
  app.exit_codes({kOk, kFailed, kUsage, kInterrupted, kTerminated});
  if (const auto code = app.parse_program(argc, argv)) {
    return *code;
  }
  return ros::run(options);
}
