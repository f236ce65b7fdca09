// SPDX-License-Identifier: Apache-2.0
#include "tools/client/robot/robot_scene.h"

#include <string>
#include <utility>
#include <vector>

#include "tools/client/robot/robot_files.h"

namespace indurop::tools {

RobotScene robot_scene_of(const config::Config& config, const std::string& module) {
  for (const RobotFiles& one : robot_files_of(config)) {
    if (one.module != module) {
      continue;
    }
    RobotScene scene{robot::list_bodies(one.names), one.workspace};
    scene.problem = scene.bodies.problem;
    auto pallets = scene.problem.empty() ? pallets_in(one.pallets, scene.bodies)
                                         : Result<std::vector<Pallet>, std::string>(std::vector<Pallet>{});
    if (pallets) {
      scene.pallets = std::move(pallets).value();
    } else {
      scene.problem = std::string("property ") + kPallets + ": " + pallets.error();
    }
    return scene;
  }
  return {};
}

}  // namespace indurop::tools
