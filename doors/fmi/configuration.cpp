// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/configuration.h"

#include <algorithm>
#include <utility>

#include "config/xml/plant_reader.h"
#include "tools/client/config/checked_config.h"

namespace indurop::fmi {
namespace {

struct Flow {
  std::map<std::string, std::size_t> owners;
  std::set<std::string> routed;
};

Flow read_board(Configuration& to, const std::filesystem::path& file) {
  // Cores that this machine lacks may be named: the FMU runs in virtual time.
  tools::CheckedConfig checked = tools::load_config(file.string(), {.machine = false});
  to.diagnostics = std::move(checked.diagnostics);
  to.plant.name = file.stem().string();
  to.plant.file = file;
  config::Board& board = to.plant.boards.emplace_back();
  board.name = "board";
  board.types = static_cast<const config::TypeFiles&>(checked.config.external);
  board.config = std::move(checked.config);
  Flow flow;
  for (const schema::Variable& variable : checked.check.schema.variables) {
    flow.owners.emplace(variable.name, 0);
  }
  to.checks.push_back(std::move(checked.check));
  return flow;
}

Flow read_plant(Configuration& to, const std::filesystem::path& file) {
  tools::CheckedPlant checked = tools::load_plant(file.string(), {});
  to.diagnostics = std::move(checked.diagnostics);
  to.plant = std::move(checked.plant);
  to.checks = std::move(checked.check.boards);
  Flow flow{std::move(checked.check.owners), {}};
  for (const config::Route& route : checked.check.routes) {
    flow.routed.insert(route.variable);
  }
  return flow;
}

}  // namespace

Configuration load_configuration(const std::filesystem::path& file) {
  Configuration configuration;
  configuration.is_plant = config::is_plant_file(file);
  const Flow flow = configuration.is_plant ? read_plant(configuration, file) : read_board(configuration, file);
  if (base::has_error(configuration.diagnostics)) {
    return configuration;
  }
  std::vector<config::BoardView> views;
  for (std::size_t i = 0; i < configuration.checks.size(); ++i) {
    const config::Board& board = configuration.plant.boards[i];
    const config::CheckResult& check = configuration.checks[i];
    views.push_back({configuration.is_plant ? board.name : std::string(), board.config, check});
    if (const base::Nanos period = check.table.basic_period; !check.periodic.empty()) {
      configuration.basic_period =
          configuration.basic_period == base::Nanos::zero() ? period : std::min(configuration.basic_period, period);
    }
  }
  configuration.variables = shared_variables(views, flow.owners, flow.routed);
  return configuration;
}

}  // namespace indurop::fmi
