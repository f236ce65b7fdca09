// SPDX-License-Identifier: Apache-2.0
#include "node/parts/external_part.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "network/mirror/external/external_type.h"
#include "node/parts/plant_part.h"
#include "store/vars/shm_file.h"

namespace indurop::node {
namespace {

using External = config::VariableRule::External;

std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMaxShown = 3;
  const std::string list = fmt::format(
      "{}",
      fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kMaxShown)), ", "));
  return names.size() > kMaxShown ? fmt::format("{} and {} more", list, names.size() - kMaxShown) : list;
}

}  // namespace

void ExternalPart::add(const std::vector<config::VariableRule>& rules, const std::string& variable,
                       std::vector<std::string> rivals) {
  const auto rule = std::find_if(rules.begin(), rules.end(), [&](const auto& r) { return r.name == variable; });
  if (rule == rules.end()) {
    settings_.variables.push_back({.variable = variable, .rivals = std::move(rivals)});
  } else if (rule->external != External::Off) {
    settings_.variables.push_back(
        {variable, nullptr, rule->external == External::Write, rule->every.count(), std::move(rivals)});
  }
}

void ExternalPart::configure(const config::Plant& plant, const config::PlantCheck& check, std::size_t board,
                             bool one_host) {
  if (!plant.external_domain || plant.types.empty()) {
    return;
  }
  wanted_ = true;
  types_ = plant.boards[board].types;
  settings_.plant = plant.name;
  settings_.network = network_settings(plant, board);
  settings_.network.domain = *plant.external_domain;
  settings_.network.one_host = one_host;
  if (plant.external_secure) {
    settings_.network.security = board_security(plant, plant.boards[board].name);
  }
  if (const std::string& own = plant.boards[board].address; !own.empty()) {
    settings_.network.peers.push_back(own);  // tools on this board
  }
  settings_.ros2 = plant.external_ros2;
  for (const config::Board& other : plant.boards) {
    settings_.boards.push_back(other.name);
  }
  for (const auto& [variable, owner] : check.owners) {
    std::vector<std::size_t> having{owner};
    if (const auto standbys = check.standbys.find(variable); standbys != check.standbys.end()) {
      having.insert(having.end(), standbys->second.begin(), standbys->second.end());
    }
    if (std::erase(having, board) > 0) {
      std::vector<std::string> rivals;
      for (const std::size_t other : having) {
        rivals.push_back(plant.boards[other].name);
      }
      add(plant.variables, variable, std::move(rivals));
    }
  }
}

void ExternalPart::configure(const config::Config& config, const config::CheckResult& check) {
  const config::ExternalPlane& plane = config.external;
  if (!plane.domain || plane.types.empty()) {
    return;
  }
  wanted_ = true;
  types_ = static_cast<const config::TypeFiles&>(plane);
  settings_.network.domain = *plane.domain;
  settings_.ros2 = plane.ros2;
  settings_.network.interface_name = plane.interface_name;
  for (const schema::Variable& variable : check.schema.variables) {
    add(plane.variables, variable.name);
  }
}

void ExternalPart::find_types(const schema::Schema& schema, Console& console) {
  std::vector<std::string> problems;
  libraries_.load(types_, problems);
  std::vector<std::string> unknown;
  std::erase_if(settings_.variables, [&](mirror::Exported& exported) {
    const schema::Variable* known = schema::find_variable(schema, exported.variable);
    if (known == nullptr) {
      return true;
    }
    const TypeLibraries::Found found = libraries_.find(mirror::descriptor_symbol(*known));
    if (found.descriptor == nullptr) {
      unknown.push_back(exported.variable);
      return true;
    }
    if (const std::string wrong = mirror::descriptor_problem(found.descriptor, *known); !wrong.empty()) {
      problems.push_back(
          fmt::format("the types library {} was built from another .glb than the modules: {}; other tools do not see "
                      "{}. Build both together",
                      found.library, wrong, exported.variable));
      return true;
    }
    exported.type = found.descriptor;
    return false;
  });
  for (const std::string& problem : problems) {
    console.error("{}", problem);
  }
  if (!unknown.empty()) {
    console.warning("no types library has the type of {}: other tools do not see {}", some_of(unknown),
                    unknown.size() == 1 ? "it" : "them");
  }
}

void ExternalPart::start(const std::string& node, vars::Store& store, const mirror::MirrorBlock* plant,
                         std::vector<int> cores, Console& console) {
  (void)vars::remove_shm_file(vars::external_file(node));  // left by an earlier run
  if (!wanted_) {
    return;
  }
  find_types(store.schema(), console);
  settings_.cores = std::move(cores);
  settings_.network.board = node;
  auto started = mirror::External::start(settings_, node, store, plant);
  if (!started) {
    console.error(
        "other tools do not see the variables: {}: {}", started.error().where,
        started.error().sys_errno != 0 ? std::strerror(started.error().sys_errno) : to_string(started.error().code));
    return;
  }
  external_ = std::move(started).value();
  const auto settable = std::count_if(settings_.variables.begin(), settings_.variables.end(),
                                      [](const mirror::Exported& exported) { return exported.writable; });
  console.info("{} variables for other tools {}in DDS domain {}, {} of them can be set", settings_.variables.size(),
               settings_.network.security.on() ? "with keys " : "", settings_.network.domain, settable);
}

}  // namespace indurop::node
