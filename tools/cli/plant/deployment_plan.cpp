// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/deployment_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

std::string title_of(const deploy::PoolPlan& pool) {
  return "pool " + printable(pool.pool);
}

}  // namespace

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
    for (const deploy::PoolPlan& pool : known.plan.pools) {
      module_width = std::max(module_width, title_of(pool).size());
    }
  }
  for (const auto& [board, known] : boards_) {
    const auto print_one = [&, &name = board](const std::string& title, deploy::ModulePlan::Act act,
                                              const std::string& why) {
      std::string line = fmt::format("  {:<{}}  {:<{}}  {:<20}  {}", printable(name), board_width, title, module_width,
                                     to_text(act), printable(why));
      line.erase(line.find_last_not_of(' ') + 1);
      context.out.message_line(line);
    };
    const deploy::BoardPlan plan = shown(known.plan);
    for (const deploy::ModulePlan& module : plan.modules) {
      print_one(printable(module.module), module.act, module.why);
    }
    for (const deploy::PoolPlan& pool : plan.pools) {
      print_one(title_of(pool), pool.act, pool.why);
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
    JsonValue pools = JsonValue::array();
    for (const deploy::PoolPlan& pool : plan.pools) {
      pools.push_back({{"pool", pool.pool}, {"plan", to_text(pool.act)}, {"why", pool.why}});
    }
    list.push_back({{"board", board},
                    {"restart", plan.restart},
                    {"tick", plan.tick},
                    {"schedule_tick", plan.schedule_tick},
                    {"left_out", plan.left_out},
                    {"modules", std::move(modules)},
                    {"pools", std::move(pools)}});
  }
  return list;
}

}  // namespace indurop::tools
