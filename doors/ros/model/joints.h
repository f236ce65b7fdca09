// SPDX-License-Identifier: Apache-2.0
// The joints of an arm as ROS names them, from its URDF file, in the order of the robot's axes.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace indurop::ros {

struct Joint {
  std::string name;
  double unit = 1;  // of the robot's axis in that of ROS: rad for a degree, m for a millimetre
};

// The moving joints from the root to the link tool0 or tcp, else to the end of the longest chain; without those that
// mimic others. Errors: everything that is wrong in the text of `file`.
Result<std::vector<Joint>, std::vector<base::Diagnostic>> read_joints(const std::filesystem::path& file,
                                                                      const std::string& text);

}  // namespace indurop::ros
