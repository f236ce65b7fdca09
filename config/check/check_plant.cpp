// SPDX-License-Identifier: Apache-2.0
// Checks every board of a plant, then the rules between boards.
#include "config/check/check_plant.h"

#include <algorithm>
#include <set>

#include "config/check/check_parts.h"
#include "config/check/plant_parts.h"
#include "core/base/text.h"
#include "core/schema/place_index.h"

namespace indurop::config {
namespace {

// Modules that use variables by name only can use those that other boards' modules declare.
void add_named_variables(const std::vector<Module>& modules, const schema::PlaceIndex& plant, schema::Schema& board) {
  const schema::PlaceIndex own(board);
  std::vector<const schema::Variable*> missing;
  std::set<const schema::Variable*> known;
  const auto look_up = [&](const std::string& name) {
    if (own.find(name, schema::NearestName::Skip)) {
      return;
    }
    const auto found = plant.find(name, schema::NearestName::Skip);
    if (found && known.insert(found.value().variable).second) {
      missing.push_back(found.value().variable);
    }
  };
  for (const Module& module : modules) {
    std::for_each(module.reads.begin(), module.reads.end(), look_up);
    std::for_each(module.writes.begin(), module.writes.end(), look_up);
  }
  for (const schema::Variable* one : missing) {
    board.variables.push_back(*one);
  }
}

class PlantCheckRun {
 public:
  PlantCheckRun(Plant& plant, const CheckOptions& options) : plant_(plant), options_(options) {
    result_.boards.resize(plant.boards.size());
    for (std::size_t i = 0; i < plant.boards.size(); ++i) {
      Board& board = plant.boards[i];
      CheckOptions own = options;
      own.machine = options.machine && (options.board.empty() || options.board == board.name);
      own.arch = board.arch;
      CheckResult& result = result_.boards[i];
      contexts_.push_back(
          {board.config, own, result, base::Diagnostics(plant.file.string(), result.diagnostics), texts_});
    }
  }

  PlantCheck run() {
    for (CheckContext& context : contexts_) {
      check_schedule(context);
    }
    if (options_.files) {
      check_boards();
      check_between();
    }
    for (CheckContext& context : contexts_) {
      check_load(context);
      context.report.add_summary(context.result.diagnostics);
    }
    for (CheckResult& board : result_.boards) {
      sort_by_severity(board.diagnostics);
      result_.diagnostics.insert(result_.diagnostics.end(), board.diagnostics.begin(), board.diagnostics.end());
    }
    result_.diagnostics.insert(result_.diagnostics.end(), between_.begin(), between_.end());
    sort_by_severity(result_.diagnostics);
    return std::move(result_);
  }

 private:
  void check_boards() {
    std::vector<std::string> differences;  // reported by check_agreement()
    for (CheckContext& context : contexts_) {
      check_machine(context);
      check_files(context);
      schema::merge(schema_, context.result.schema, differences);
    }
    const schema::PlaceIndex index(schema_);
    for (CheckContext& context : contexts_) {
      add_named_variables(context.config.modules, index, context.result.schema);
      check_data_flow(context);
      if (options_.kept) {
        check_kept(context);
      }
    }
  }

  void check_between() {
    base::Diagnostics report(plant_.file.string(), between_);
    const std::vector<BoardView> views = views_of(plant_, result_);
    const Uses uses(views);
    PlantContext context{plant_, views, uses, schema_, report};
    check_type_libraries(report);
    check_agreement(views, report);
    resolve_rules(plant_.variables, schema_, report);
    check_external_rules(plant_.variables, plant_.external_domain && !plant_.types.empty(), uses, report);
    if (plant_.external_domain) {
      check_foreign_types(plant_, plant_.variables, schema_, report);
    }
    result_.routes = find_routes(context, result_);
    add_owners_of_the_rest();
    std::set<std::string> set_by_hand;
    for (const VariableRule& rule : plant_.variables) {
      if (!rule.owner.empty() || rule.external == VariableRule::External::Write) {
        set_by_hand.insert(rule.name);
      }
    }
    check_writers(uses, set_by_hand, report);
    check_ages(context, result_.routes);
    check_pools(context);
    check_security(plant_, options_, report);
    report.add_summary(between_);
  }

  // What is wrong for all boards is reported once.
  void check_type_libraries(base::Diagnostics& report) {
    for (std::size_t library = 0; library < plant_.types.size(); ++library) {
      std::set<std::string> problems{""};
      for (std::size_t board = 0; board < contexts_.size(); ++board) {
        const std::string problem = type_library_problem(plant_.boards[board].types, library, contexts_[board].options);
        if (problems.insert(problem).second) {
          report.error(plant_.type_places[library], problem);
        }
      }
    }
  }

  void add_owners_of_the_rest() {
    for (std::size_t board = 0; board < result_.boards.size(); ++board) {
      for (const schema::Variable& variable : result_.boards[board].schema.variables) {
        result_.owners.try_emplace(variable.name, board);
      }
    }
  }

  Plant& plant_;
  const CheckOptions& options_;
  PlantCheck result_;
  std::vector<CheckContext> contexts_;  // of the boards, in their order
  std::vector<base::Diagnostic> between_;
  SchemaTexts texts_;
  schema::Schema schema_;  // of all boards
};

}  // namespace

bool PlantCheck::ok() const noexcept {
  return !base::has_error(diagnostics);
}

PlantCheck check_plant(Plant& plant, const CheckOptions& options) {
  return PlantCheckRun(plant, options).run();
}

}  // namespace indurop::config
