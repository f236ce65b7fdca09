// SPDX-License-Identifier: Apache-2.0
#include "tools/client/robot/work_frames.h"

#include "control/robot/files/teach.h"
#include "tools/client/robot/robot_files.h"

namespace indurop::tools {

std::vector<std::string> work_frames_of(const config::Config& config, const std::string& module) {
  for (const RobotFiles& one : robot_files_of(config)) {
    if (one.module == module) {
      return robot::list_points(one.names).frames;
    }
  }
  return {};
}

}  // namespace indurop::tools
