// SPDX-License-Identifier: Apache-2.0
#include "tools/client/robot/robot_desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "config/xml/plant_reader.h"
#include "store/operate/item.h"
#include "tools/client/config/checked_config.h"
#include "tools/client/node/node_choice.h"

namespace indurop::tools {
namespace {

// Returns the elements of an array of double.
std::vector<double> numbers_of(const std::vector<std::uint8_t>& bytes) {
  std::vector<double> out(bytes.size() / sizeof(double));
  std::memcpy(out.data(), bytes.data(), out.size() * sizeof(double));
  return out;
}

// Returns, for a plant, the configuration of the node's board.
config::Config config_of(const std::string& file, const std::string& board) {
  const config::CheckOptions options{.files = false, .adjust = true};
  if (!config::is_plant_file(file)) {
    return load_config(file, options).config;
  }
  CheckedPlant checked = load_plant(file, options);
  const auto found = std::find_if(checked.plant.boards.begin(), checked.plant.boards.end(),
                                  [&](const auto& one) { return one.name == board; });
  return found == checked.plant.boards.end() ? config::Config{} : found->config;
}

// Returns the robot that is chosen of these. `where`: what has them, for messages.
Result<RobotFiles, Failure> chosen_of(std::vector<RobotFiles> robots, const RobotChoice& choice,
                                      const std::string& where) {
  std::string known;
  for (const RobotFiles& one : robots) {
    known += (known.empty() ? "" : ", ") + one.module;
  }
  std::erase_if(robots, [&](const RobotFiles& one) { return !choice.module.empty() && one.module != choice.module; });
  if (robots.size() == 1) {
    return std::move(robots.front());
  }
  if (known.empty()) {
    return Failure{kFailed, fmt::format("{} has no robot (a module with the property urdf or jobs)", where)};
  }
  return Failure{kUsage, fmt::format("{} has the robots {}: choose one with --module", where, known)};
}

}  // namespace

Result<RobotPlace, base::Problem> read_place(const vars::Store& store, const std::string& space) {
  RobotPlace to;
  std::vector<std::vector<std::uint8_t>> values;
  for (const char* part : {"joint", "speed", "position", "orientation", "tool"}) {
    const auto item = operate::find(store, fmt::format("{}{}ROBOT_ARM.{}", space, space.empty() ? "" : "::", part));
    if (!item) {
      return item.error();
    }
    auto bytes = operate::read(store, *item);
    if (!bytes) {
      return bytes.error();
    }
    values.push_back(std::move(bytes).value());
  }
  to.stand.joints = numbers_of(values[0]);
  for (const auto& [bytes, place] : {std::pair(&values[2], &to.stand.position), {&values[3], &to.stand.orientation}}) {
    const auto numbers = numbers_of(*bytes);
    std::copy_n(numbers.begin(), std::min(numbers.size(), place->size()), place->begin());
  }
  const auto* text = reinterpret_cast<const char*>(values[4].data());
  to.tool.assign(text, ::strnlen(text, values[4].size()));
  to.tool = to.tool == "FLANGE" ? "" : to.tool;
  const auto speed = numbers_of(values[1]);
  to.moves = std::any_of(speed.begin(), speed.end(), [](double one) { return std::abs(one) > 1e-6; });
  return to;
}

Result<RobotFiles, Failure> files_of_node(const std::string& node, const RobotChoice& choice, bool to_change) {
  const auto chosen = open_run(node);
  if (!chosen) {
    return chosen.error();
  }
  const scheduler::RunBlock& run = chosen->run.block();
  if (to_change && choice.config.empty() && run.deployment[0] != '\0') {
    return Failure{kFailed, fmt::format("node '{}' runs what was deployed to it ({}), a copy that the next deployment "
                                        "replaces; name your own manifest with --config, and deploy it",
                                        chosen->node, run.deployment)};
  }
  const std::string usual = run.plant_file[0] != '\0' ? run.plant_file : run.config_file;
  const std::string config = choice.config.empty() ? usual : choice.config;
  return chosen_of(robot_files_of(config_of(config, run.board)), choice,
                   fmt::format("node '{}' ({})", chosen->node, config));
}

Result<RobotFiles, Failure> files_of_config(const RobotChoice& choice) {
  const config::CheckOptions options{.files = false, .adjust = true};
  std::vector<RobotFiles> robots;
  if (!config::is_plant_file(choice.config)) {
    robots = robot_files_of(load_config(choice.config, options).config);
  } else {
    for (const auto& board : load_plant(choice.config, options).plant.boards) {
      const std::vector<RobotFiles> more = robot_files_of(board.config);
      robots.insert(robots.end(), more.begin(), more.end());
    }
  }
  return chosen_of(std::move(robots), choice, choice.config);
}

}  // namespace indurop::tools
