// SPDX-License-Identifier: Apache-2.0
// `indurop-ros1`: the variables and the arm of a node for programs of ROS 1.

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "core/base/exit_code.h"
#include "core/base/read_file.h"
#include "core/base/stop_signal.h"
#include "core/base/text.h"
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

int fail_with(const std::string& text, int code) {
  fmt::print(stderr, "indurop-ros1: error: {}\n", text);
  return code;
}

int run(const Ros1Options& options) {
  base::StopSignal stop;
  std::string urdf;
  std::vector<Joint> joints;
  if (options.move && options.urdf.empty()) {
    return fail_with("--move needs --urdf FILE, which has the joints of the arm", kUsage);
  }
  if (!options.urdf.empty()) {
    const auto text = base::read_file(options.urdf);
    if (!text) {
      return fail_with(base::cannot_read(options.urdf, text.error()), kUsage);
    }
    urdf = *text;
    auto found = read_joints(options.urdf, urdf);
    if (!found) {
      fmt::print(stderr, "{}", base::to_text(found.error()));
      return kUsage;
    }
    joints = std::move(*found);
  }
  Ros1Door door(options, std::move(joints), std::move(urdf));
  if (const auto done = door.run(stop); !done) {
    return fail_with(done.error().text, kFailed);
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
