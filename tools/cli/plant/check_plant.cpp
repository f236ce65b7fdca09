// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/check_plant.h"
#include "tools/console/table_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/check/uses.h"
#include "config/xml/reader.h"
#include "tools/cli/plant/pool_tables.h"
#include "tools/client/config/checked_config.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

using Names = std::vector<std::string>;

Cell duration(base::Nanos value) {
  return {value > base::Nanos::zero() ? base::format_duration(value) : "", value.count()};
}

// Returns the number of runs of periodic modules in a second.
double runs_per_second(const config::Config& config, const config::CheckResult& check) {
  double runs = 0;
  for (const std::size_t i : check.periodic) {
    runs += 1e9 / static_cast<double>(std::max<std::int64_t>(config.modules[i].period.count(), 1));
  }
  return runs;
}

class View {
 public:
  explicit View(const CheckedPlant& checked)
      : checked_(checked), views_(config::views_of(checked.plant, checked.check)), uses_(views_) {
    for (const config::CheckResult& board : checked.check.boards) {
      for (const schema::Variable& variable : board.schema.variables) {
        types_.emplace(variable.name, schema::display_name(variable.type));
      }
    }
  }

  [[nodiscard]] Table boards() const {
    Table table({{"BOARD", "name"},
                 {"ADDRESS", "address", Align::Left, 2},
                 {"INTERFACE", "interface", Align::Left, 2},
                 {"MODULES", "modules", Align::Right},
                 {"BASIC PERIOD", "basic_period_ns", Align::Right},
                 {"MACRO PERIOD", "macro_period_ns", Align::Right},
                 {"SLOTS", "slots", Align::Right, 3},
                 {"RUNS/S", "runs_per_s", Align::Right},
                 {"SENDS", "sends", Align::Right, 1},
                 {"GETS", "gets", Align::Right, 1}});
    const auto number = [](std::size_t n) { return Cell(std::to_string(n), JsonValue(n)); };
    for (std::size_t i = 0; i < checked_.check.boards.size(); ++i) {
      const config::Board& board = checked_.plant.boards[i];
      const config::CheckResult& check = checked_.check.boards[i];
      const double runs = runs_per_second(board.config, check);
      table.add({Cell(board.name), Cell(board.address), Cell(board.interface_name), number(board.config.modules.size()),
                 duration(check.table.basic_period), duration(check.table.macro_period), number(check.table.slot_count),
                 Cell(fmt::format("{:.6g}", runs), JsonValue(runs)), number(sent_by(i)), number(got_by(i))});
    }
    return table;
  }

  [[nodiscard]] Table routes() const {
    Table table({{"VARIABLE", "variable"},
                 {"TYPE", "type", Align::Left, 4},
                 {"OWNER", "owner"},
                 {"", "to"},
                 {"WRITTEN BY", "writers", Align::Left, 2},
                 {"READ BY", "readers"},
                 {"AGE UP TO", "oldest_ns", Align::Right, 1},
                 {"AT MOST EVERY", "every_ns", Align::Right, 3},
                 {"RELIABILITY", "reliability", Align::Left, 3}});
    for (const config::Route& route : checked_.check.routes) {
      const config::Users& users = uses_.variables().at(route.variable);
      table.add(
          {Cell(route.variable), Cell(type_of(route.variable)), Cell(board_name(route.owner)),
           name_list(board_names(route.readers)), name_list(uses_.names(on({route.owner}, users.writers))),
           name_list(uses_.names(on(route.readers, users.readers))), duration(route.oldest), duration(route.every),
           Cell(route.best_effort ? "best-effort" : "", JsonValue(route.best_effort ? "best-effort" : "reliable"))});
    }
    return table;
  }

  // All shared variables, sent between boards or not.
  [[nodiscard]] Table variables() const {
    Table table({{"VARIABLE", "name"}, {"TYPE", "type"}, {"WRITTEN BY", "writers"}, {"READ BY", "readers"}});
    for (const auto& [name, users] : uses_.variables()) {
      table.add({Cell(name), Cell(type_of(name)), name_list(uses_.names(users.writers)),
                 name_list(uses_.names(users.readers))});
    }
    return table;
  }

  [[nodiscard]] std::string summary() const {
    std::size_t modules = 0;
    std::size_t undeclared = 0;
    for (std::size_t i = 0; i < checked_.check.boards.size(); ++i) {
      modules += checked_.plant.boards[i].config.modules.size();
      undeclared += checked_.check.boards[i].undeclared.size();
    }
    return fmt::format("{}, {}, {}, {} between boards{}{}", counted(checked_.plant.boards.size(), "board"),
                       counted(modules, "module"), counted(uses_.variables().size(), "shared variable"),
                       checked_.check.routes.size(), counted_pools(pool_table(checked_).rows().size()),
                       without_state(undeclared));
  }

 private:
  [[nodiscard]] std::string type_of(const std::string& variable) const {
    const auto found = types_.find(variable);
    return found == types_.end() ? "?" : found->second;
  }
  [[nodiscard]] const std::string& board_name(std::size_t board) const { return checked_.plant.boards[board].name; }
  [[nodiscard]] Names board_names(const std::vector<std::size_t>& boards) const {
    Names names;
    for (const std::size_t board : boards) {
      names.push_back(board_name(board));
    }
    return names;
  }
  static std::vector<config::User> on(const std::vector<std::size_t>& boards, const std::vector<config::User>& users) {
    std::vector<config::User> some;
    std::copy_if(users.begin(), users.end(), std::back_inserter(some), [&](const config::User& user) {
      return std::find(boards.begin(), boards.end(), user.board) != boards.end();
    });
    return some;
  }
  [[nodiscard]] std::size_t sent_by(std::size_t board) const {
    const auto& routes = checked_.check.routes;
    return static_cast<std::size_t>(std::count_if(
        routes.begin(), routes.end(), [board](const config::Route& route) { return route.owner == board; }));
  }
  [[nodiscard]] std::size_t got_by(std::size_t board) const {
    const auto& routes = checked_.check.routes;
    return static_cast<std::size_t>(std::count_if(routes.begin(), routes.end(), [board](const config::Route& route) {
      return std::find(route.readers.begin(), route.readers.end(), board) != route.readers.end();
    }));
  }

  const CheckedPlant& checked_;
  std::vector<config::BoardView> views_;
  config::Uses uses_;
  std::map<std::string, std::string> types_;
};

JsonValue head(const CheckedPlant& checked, const View& view) {
  const config::Plant& plant = checked.plant;
  return {{"ok", checked.ok()},
          {"file", plant.file.string()},
          {"plant", plant.name},
          {"domain", plant.domain},
          {"external_domain", plant.external_domain ? JsonValue(*plant.external_domain) : JsonValue()},
          {"multicast", plant.multicast},
          {"lease_ns", plant.lease.count()},
          {"diagnostics", diagnostics_json(checked.diagnostics)},
          {"boards", view.boards().json()},
          {"variables", view.variables().json()},
          {"pools", pool_table(checked).json()}};
}

}  // namespace

std::string without_state(std::size_t modules) {
  return modules == 0 ? "" : ", " + counted(modules, "module") + " without INDUROP_STATE";
}

int check_plant_file(Context& context, const std::string& file, const config::CheckOptions& options) {
  const CheckedPlant checked = load_plant(file, options);
  const View view(checked);
  if (context.format == Format::Csv) {
    print_diagnostics(context, checked.diagnostics, false);
    context.out.write(view.routes().csv());
  } else if (context.format == Format::Json) {
    print_table(context, view.routes(), head(checked, view), "routes");
  } else {
    print_diagnostics(context, checked.diagnostics, true);
    for (const Table& table : {view.boards(), view.routes(), pool_table(checked)}) {
      if (!context.out.quiet() && !table.empty()) {
        context.out.write(table_text(table, context.out));
        context.out.line();
      }
    }
    print_verdict(context, checked.diagnostics, view.summary());
  }
  return checked.ok() ? kOk : kCheckFailed;
}

}  // namespace indurop::tools
