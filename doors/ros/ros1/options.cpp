// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros1/options.h"

namespace indurop::ros {

void declare_options(base::Options& app, Ros1Options& options) {
  constexpr double kLeastHz = 0.1;
  constexpr double kMostHz = 200;
  app.add("--node", "NAME", options.node, "The node of InduRoP (default: local, or the only one that runs)");
  app.add("--variables", "GLOB", options.variables, "Publish these variables (default: all); '' for none")
      .one_at_a_time()
      .completes(base::Completion::Variable);
  app.add("--rate", "HZ", options.rate_hz, "How often joint states and changed values are published (default 50)")
      .range(kLeastHz, kMostHz);
  app.add("--urdf", "FILE", options.urdf, "The arm of the node's robot: its joints, and robot_description")
      .completes(base::Completion::File);
  app.add("--robot", "NAMESPACE", options.robot, "Namespace of the robot's variables (default PLC_ROBOT)");
  app.add("--controller", "NAME", options.controller, "Name of the controller for clients (default arm_controller)");
  app.flag("--move", options.move, "Let clients move the arm; anyone who reaches the master is one");
  app.add("--ros", "NAME:=VALUE", options.arguments, "An argument for roscpp, such as joint_states:=cell/joint_states")
      .one_at_a_time();
  app.flag("-q,--quiet", options.quiet, "Print warnings and errors only");
}

}  // namespace indurop::ros
