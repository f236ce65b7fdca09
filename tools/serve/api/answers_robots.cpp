// SPDX-License-Identifier: Apache-2.0
// Answers about the robot arms of a board: the URDF files of its robot modules.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "config/xml/plant_reader.h"
#include "core/base/read_file.h"
#include "tools/client/config/checked_config.h"
#include "tools/client/robot/work_frames.h"
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

// Files of a module are relative to the folder of its configuration.
void add_robots(base::Json& robots, const config::Config& config, const tools::RunView& run,
                const std::filesystem::path& folder) {
  for (const config::Module& module : config.modules) {
    const auto property = std::find_if(module.properties.begin(), module.properties.end(),
                                       [](const config::Property& one) { return one.name == "urdf"; });
    if (property == module.properties.end() || !runs_in(run, module.name)) {
      continue;
    }
    auto text = base::read_file(folder / property->value, kMostBytes);
    if (!text.ok()) {
      continue;
    }
    base::Json one = base::Json::object();
    one["module"] = module.name;
    one["urdf"] = std::move(text).value();
    one["frames"] = base::Json::array();
    for (const std::string& frame : tools::work_frames_of(config, module.name)) {
      one["frames"].push_back(frame);
    }
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
