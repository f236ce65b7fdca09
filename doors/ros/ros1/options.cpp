// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros1/options.h"

namespace indurop::ros {

void declare_options(base::Options& app, Ros1Options& options) {
  declare_arm_options(app, options.arm, "joint states and changed values are", "anyone who reaches the master is one");
  app.add("--variables", "GLOB", options.variables, "Publish these variables (default: all); '' for none")
      .one_at_a_time()
      .completes(base::Completion::Variable);
  app.add("--ros", "NAME:=VALUE", options.arguments, "An argument for roscpp, such as joint_states:=cell/joint_states")
      .one_at_a_time();
}

}  // namespace indurop::ros
