// SPDX-License-Identifier: Apache-2.0
// URDF, job and point files of robot modules, read as the modules read them when the node starts.

#pragma once

#include <string>
#include <vector>

#include "config/check/check.h"
#include "control/robot/files/files.h"

namespace indurop::tools {

// Returns the errors in these files. A robot module is one that has the property `urdf` or `jobs` and, if its file can
// be read, reads URDF.
std::vector<base::Diagnostic> check_robot_files(const config::Config& config, const config::CheckResult& check);

// The robot modules of a configuration, and their files. A module without jobs that reads the URDF of one with jobs
// simulates that arm, and is none.
struct RobotFiles {
  std::string module;
  robot::FileNames names;
  std::vector<double> workspace;  // the property, as Settings::workspace; empty: none, or a wrong one
  std::string pallets;            // the property, see pallets_in()
};
std::vector<RobotFiles> robot_files_of(const config::Config& config);

}  // namespace indurop::tools
