// SPDX-License-Identifier: Apache-2.0
// The command line of indurop-ros1.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/options.h"

namespace indurop::ros {

struct Ros1Options {
  std::string node;                    // of InduRoP; empty: the usual one
  std::vector<std::string> variables;  // globs; none: all
  double rate_hz = 50;
  std::filesystem::path urdf;  // empty: no arm
  std::string robot = "PLC_ROBOT";
  std::string controller = "arm_controller";
  bool move = false;
  std::vector<std::string> arguments;  // of roscpp
  bool quiet = false;
};
void declare_options(base::Options& app, Ros1Options& options);

}  // namespace indurop::ros
