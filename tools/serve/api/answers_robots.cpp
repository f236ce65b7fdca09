// SPDX-License-Identifier: Apache-2.0
// Answers about the robot arms of a board: the URDF files of its robot modules, and what is around the arms.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "config/xml/plant_reader.h"
#include "core/base/read_file.h"
#include "tools/client/config/checked_config.h"
#include "tools/client/robot/robot_files.h"
#include "tools/client/robot/robot_scene.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve::answers {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20U;

bool runs_in(const tools::RunView& run, const std::string& name) {
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    if (run.module_name(static_cast<int>(i)) == name) {
      return true;
    }
  }
  return false;
}

base::Json list_of_bodies(const std::vector<robot::ListedBody>& bodies) {
  base::Json list = base::Json::array();
  for (const robot::ListedBody& body : bodies) {
    base::Json one = base::Json::object();
    one["name"] = body.name;
    if (body.tool > 0) {
      one["tool"] = body.tool;
    }
    one["kind"] = body.kind;
    one["size"] = list_of(body.size);
    one["position"] = list_of(body.position);
    one["orientation"] = list_of(body.orientation);
    list.push_back(std::move(one));
  }
  return list;
}

base::Json list_of_frames(const std::vector<robot::ListedFrame>& frames) {
  base::Json list = base::Json::array();
  for (const robot::ListedFrame& frame : frames) {
    base::Json one = base::Json::object();
    one["name"] = frame.name;
    one["position"] = list_of(frame.position);
    one["orientation"] = list_of(frame.orientation);
    one["computed"] = frame.computed;
    one["points"] = base::Json::array();
    for (const auto& point : frame.points) {
      one["points"].push_back({{"name", point.name}, {"position", list_of(point.position)}});
    }
    list.push_back(std::move(one));
  }
  return list;
}

base::Json list_of_belts(const std::vector<robot::ListedBelt>& belts) {
  base::Json list = base::Json::array();
  for (const robot::ListedBelt& belt : belts) {
    list.push_back({{"number", belt.number},
                    {"turns", belt.turns},
                    {"along", belt.along},
                    {"part", belt.part},
                    {"length", belt.length}});
  }
  return list;
}

base::Json list_of_pallets(const std::vector<tools::Pallet>& pallets) {
  base::Json list = base::Json::array();
  for (const tools::Pallet& pallet : pallets) {
    base::Json one = base::Json::object();
    one["name"] = pallet.name;
    one["frame"] = pallet.frame;
    one["orientation"] = list_of(pallet.orientation);
    one["size"] = list_of(pallet.size);
    one["used"] = pallet.used;
    one["places"] = base::Json::array();
    for (const auto& place : pallet.places) {
      one["places"].push_back(list_of(place));
    }
    list.push_back(std::move(one));
  }
  return list;
}

void add_scene(base::Json& robot, const tools::RobotScene& scene) {
  robot["frames"] = base::Json::array();
  for (const std::string& frame : scene.bodies.frames) {
    robot["frames"].push_back(frame);
  }
  robot["work_frames"] = list_of_frames(scene.bodies.work_frames);
  robot["belts"] = list_of_belts(scene.bodies.belts);
  robot["pallets"] = list_of_pallets(scene.pallets);
  robot["zones"] = list_of_bodies(scene.bodies.zones);
  robot["bodies"] = list_of_bodies(scene.bodies.tools);
  robot["workspace"] = list_of(scene.workspace);
  if (!scene.problem.empty()) {
    robot["problem"] = scene.problem;
  }
}

// Files of a module are relative to the folder of its configuration.
void add_robots(base::Json& robots, const config::Config& config, const tools::RunView& run,
                const std::filesystem::path& folder) {
  const std::vector<tools::RobotFiles> known = tools::robot_files_of(config);
  for (const config::Module& module : config.modules) {
    const bool is_robot = std::any_of(known.begin(), known.end(),
                                      [&module](const tools::RobotFiles& one) { return one.module == module.name; });
    const auto property = std::find_if(module.properties.begin(), module.properties.end(),
                                       [](const config::Property& one) { return one.name == "urdf"; });
    if (!is_robot || property == module.properties.end() || !runs_in(run, module.name)) {
      continue;
    }
    auto text = base::read_file(folder / property->value, kMostBytes);
    if (!text.ok()) {
      continue;
    }
    base::Json one = base::Json::object();
    one["module"] = module.name;
    one["urdf"] = std::move(text).value();
    add_scene(one, tools::robot_scene_of(config, module.name));
    robots.push_back(std::move(one));
  }
}

}  // namespace

Reply robots(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  base::Json list = base::Json::array();
  if (const auto run = (*found)->run()) {
    const std::filesystem::path file = tools::fixed_text(run->block().config_file);
    const config::CheckOptions options{.files = false, .adjust = true};
    if (config::is_plant_file(file)) {
      const tools::CheckedPlant checked = tools::load_plant(file, options);
      for (const config::Board& board : checked.plant.boards) {
        if (board.name == (*found)->name()) {
          add_robots(list, board.config, *run, file.parent_path());
        }
      }
    } else {
      add_robots(list, tools::load_config(file, options).config, *run, file.parent_path());
    }
  }
  base::Json body = about(**found);
  body["robots"] = std::move(list);
  return json_reply(body);
}

}  // namespace indurop::serve::answers
