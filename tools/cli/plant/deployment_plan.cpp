// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/deployment_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {

void DeploymentPlan::receive(const deploy::BoardReport& report) {
  if (report.plan.empty() || boards_[report.board].text == report.plan) {
    return;
  }
  if (auto plan = deploy::parse_board_plan(report.plan)) {
    boards_[report.board] = {report.plan, std::move(*plan)};
  }
}

std::string DeploymentPlan::restart() const {
  for (const auto& [board, known] : boards_) {
    if (!known.plan.restart.empty()) {
      const bool names_board = known.plan.restart.starts_with("board ");
      return names_board ? known.plan.restart : fmt::format("board {}: {}", board, known.plan.restart);
    }
  }
  return "";
}

deploy::BoardPlan DeploymentPlan::shown(const deploy::BoardPlan& plan) const {
  return restart().empty() ? plan : deploy::restarted(plan);
}

void DeploymentPlan::print(Context& context) {
  if (std::exchange(printed_, true) || boards_.empty() || context.out.quiet()) {
    return;
  }
  std::size_t board_width = 0;
  std::size_t module_width = 0;
  for (const auto& [board, known] : boards_) {
    board_width = std::max(board_width, printable(board).size());
    for (const deploy::ModulePlan& module : known.plan.modules) {
      module_width = std::max(module_width, printable(module.module).size());
    }
  }
  for (const auto& [board, known] : boards_) {
    for (const deploy::ModulePlan& module : shown(known.plan).modules) {
      std::string line =
          fmt::format("  {:<{}}  {:<{}}  {:<20}  {}", printable(board), board_width, printable(module.module),
                      module_width, to_text(module.act), printable(module.why));
      line.erase(line.find_last_not_of(' ') + 1);
      context.out.message_line(line);
    }
  }
  if (const std::string why = restart(); !why.empty() && module_width > 0) {
    context.out.message_line("  the nodes are restarted; " + printable(why));
  }
}

void DeploymentPlan::print_ticks(Context& context) const {
  for (const auto& [board, known] : boards_) {
    if (known.plan.tick > 0 && !context.out.quiet()) {
      context.out.message_line(fmt::format("  {} exchanged its modules in tick {}; {} without new values",
                                           printable(board), known.plan.tick, counted(known.plan.left_out, "tick")));
    }
    if (known.plan.schedule_tick > 0 && !context.out.quiet()) {
      context.out.message_line(
          fmt::format("  {} runs by its new schedule since tick {}", printable(board), known.plan.schedule_tick));
    }
  }
}

JsonValue DeploymentPlan::json() const {
  JsonValue list = JsonValue::array();
  for (const auto& [board, known] : boards_) {
    const deploy::BoardPlan plan = shown(known.plan);
    JsonValue modules = JsonValue::array();
    for (const deploy::ModulePlan& module : plan.modules) {
      modules.push_back({{"module", module.module}, {"plan", to_text(module.act)}, {"why", module.why}});
    }
    list.push_back({{"board", board},
                    {"restart", plan.restart},
                    {"tick", plan.tick},
                    {"schedule_tick", plan.schedule_tick},
                    {"left_out", plan.left_out},
                    {"modules", std::move(modules)}});
  }
  return list;
}

}  // namespace indurop::tools
