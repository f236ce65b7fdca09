// SPDX-License-Identifier: Apache-2.0
#include "tools/client/robot/robot_scene.h"

#include "tools/client/robot/robot_files.h"

namespace indurop::tools {

RobotScene robot_scene_of(const config::Config& config, const std::string& module) {
  for (const RobotFiles& one : robot_files_of(config)) {
    if (one.module == module) {
      return {robot::list_bodies(one.names), one.workspace};
    }
  }
  return {};
}

}  // namespace indurop::tools
