// SPDX-License-Identifier: Apache-2.0
// The command line of indurop-ros1.

#pragma once

#include <string>
#include <vector>

#include "core/base/options.h"
#include "doors/ros/arm/arm_options.h"

namespace indurop::ros {

struct Ros1Options {
  ArmOptions arm;
  std::vector<std::string> variables;  // globs; none: all
  std::vector<std::string> arguments;  // of roscpp
};
void declare_options(base::Options& app, Ros1Options& options);

}  // namespace indurop::ros
