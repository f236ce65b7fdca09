// SPDX-License-Identifier: Apache-2.0
// indurop status: is the node well, what real-time rights did it get, how do its modules do.
#include <fmt/format.h>

#include "config/xml/reader.h"
#include "rt/clock.h"
#include "tools/command/interrupt.h"
#include "tools/command/repeat.h"
#include "tools/command/units.h"
#include "tools/plant/board_run.h"
#include "tools/plant/plant_status.h"
#include "tools/values/external_view.h"
#include "tools/values/force_view.h"
#include "tools/values/mirror_view.h"
#include "tools/values/run_report.h"
#include "tools/verbs/verbs.h"

namespace indurop::tools {
namespace {

std::string fault_text(const scheduler::ModuleRecord& module) {
  const auto kind = static_cast<scheduler::FaultKind>(module.fault_kind.load(std::memory_order_acquire));
  if (kind == scheduler::FaultKind::None) {
    return {};
  }
  return fmt::format("{} (tick {})", fixed_text(module.last_fault), module.fault_tick.load(std::memory_order_relaxed));
}

Style style_of(scheduler::ModuleState state) {
  switch (state) {
    case scheduler::ModuleState::Running:
      return Style::Good;
    case scheduler::ModuleState::Loaded:
    case scheduler::ModuleState::Starting:
    case scheduler::ModuleState::Restarting:
      return Style::Warn;
    case scheduler::ModuleState::Faulted:
      return Style::Bad;
    case scheduler::ModuleState::Stopped:
    case scheduler::ModuleState::Exited:
      return Style::Dim;
  }
  return Style::None;
}

Cell counter(std::uint64_t value, Style if_any = Style::None) {
  return {std::to_string(value), value, value > 0 ? if_any : Style::Dim};
}
Cell duration(std::int64_t ns, bool known = true) {
  return {known ? human_ns(ns) : "-", ns};
}

std::vector<Cell> module_row(const scheduler::ModuleRecord& module, bool alive) {
  constexpr auto kRelaxed = std::memory_order_relaxed;
  const auto state = module.state.load(kRelaxed);
  const auto exec = scheduler::summarize(module.exec);
  const auto jitter = scheduler::summarize(module.jitter);
  const bool ran = exec.count > 0;
  const bool real = module.operation != scheduler::Operation::NonReal;
  const std::string period =
      module.period_ns > 0 ? base::format_duration(base::Nanos(module.period_ns)) : to_text(module.operation);
  return {Cell(fixed_text(module.name), Style::Bold),
          Cell(to_text(module.type)),
          {period, module.period_ns},
          {"", to_text(module.operation)},
          {real ? std::to_string(module.priority) : "-", module.priority},
          {alive ? to_text(state) : fmt::format("({})", to_text(state)), to_text(state),
           alive ? style_of(state) : Style::Dim},
          {"", module.pid.load(kRelaxed)},
          counter(module.runs.load(kRelaxed)),
          counter(module.skipped.load(kRelaxed), Style::Warn),
          counter(module.overruns.load(kRelaxed), Style::Warn),
          counter(module.deadline_misses.load(kRelaxed), Style::Warn),
          duration(module.last_exec_ns.load(kRelaxed), ran),
          duration(exec.mean, ran),
          duration(exec.max, ran),
          duration(jitter.p50, jitter.count > 0),
          duration(jitter.p99, jitter.count > 0),
          duration(jitter.max, jitter.count > 0),
          counter(module.restarts.load(kRelaxed), Style::Warn),
          counter(module.lost_messages.load(kRelaxed), Style::Warn),
          {fault_text(module), fault_text(module), Style::Bad}};
}

Table module_table(const RunView& run, bool alive) {
  constexpr Align kRight = Align::Right;
  Table table({{"MODULE", "name"},
               {"TYPE", "type", Align::Left, 4},
               {"PERIOD", "period_ns", kRight},
               {"", "operation"},
               {"PRIO", "priority", kRight, 2},
               {"STATE", "state"},
               {"", "pid"},
               {"RUNS", "runs", kRight},
               {"SKIPPED", "skipped", kRight, 1},
               {"OVERRUNS", "overruns", kRight},
               {"MISSES", "deadline_misses", kRight},
               {"EXEC LAST", "last_exec_ns", kRight, 6},
               {"EXEC AVG", "mean_exec_ns", kRight},
               {"MAX", "max_exec_ns", kRight},
               {"JITTER P50", "jitter_p50_ns", kRight, 3},
               {"JITTER P99", "jitter_p99_ns", kRight},
               {"MAX", "jitter_max_ns", kRight, 1},
               {"RESTARTS", "restarts", kRight, 5},
               {"", "lost_messages"},
               {"LAST FAULT", "last_fault"}});
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    table.add(module_row(run.module(i), alive));
  }
  return table;
}

std::vector<ForceView> forces_here(const std::string& node) {
  const auto store = vars::Store::attach(node, vars::Mode::ReadOnly);
  return store ? view_forces(*store) : std::vector<ForceView>();
}

int show_once(Context& context, const BoardRun& chosen) {
  const std::string& node = chosen.node;
  const RunView& run = chosen.run;
  const NodeReport report = report_of(node, run);
  const auto mirror = run.here() ? view_mirror(node) : std::nullopt;
  const auto external = run.here() ? view_external(node) : std::nullopt;
  const auto forces = chosen.forces ? *chosen.forces : forces_here(node);
  if (context.format == Format::Table) {
    for (const std::string& line : header_lines(report, context.out)) {
      context.out.line(line);
    }
    if (!forces.empty()) {
      context.out.line(context.out.paint(Style::Warn, "  forced    " + force_line(forces)));
    }
    if (mirror) {
      for (const std::string& line : mirror_lines(*mirror, context.out)) {
        context.out.line(line);
      }
    }
    if (external) {
      for (const std::string& line : external_lines(*external, context.out)) {
        context.out.line(line);
      }
    }
    context.out.line();
  }
  JsonValue head = json_of(report);
  head["mirror"] = mirror ? json_of(*mirror) : JsonValue();
  head["forces"] = json_of(forces);
  head["external"] = external ? json_of(*external) : JsonValue();
  print_table(context, module_table(run, report.alive), head, "modules");
  return report.alive || chosen.kept ? kOk : kUnreachable;
}

Action declare(base::Options& app, Context& context) {
  auto repeat = std::make_shared<Repeat>();
  auto plant = std::make_shared<PlantStatus>();
  auto board = std::make_shared<BoardChoice>();
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  add_repeat_options(app, *repeat);
  app.flag("--plant", plant->wanted, "All boards of the network, from any machine; boards not heard are named");
  deploy::add_link_options(app, board->link);
  add_board_options(app, *board, false);
  add_kept_option(app, *board);
  return [repeat, plant, board](Context& c) {
    plant->link = board->link;
    return repeat_rounds(c, *repeat, [&c, &plant, &board] {
      if (plant->wanted) {
        return plant->show(c);
      }
      const auto chosen = open_run(c, *board);
      return chosen ? show_once(c, *chosen) : report(c.out, chosen.error());
    });
  };
}

}  // namespace

const Verb kStatusVerb{
    "status", "A running node", "Show the state of the node and its modules",
    "EXEC is the execution time of run(), JITTER |J_n|: how far a start was from its place on the grid. A state in\n"
    "brackets is the last one of a node that has ended. On a narrow terminal some columns are left out.\n"
    "Exit code 0 if the node runs, 6 if it does not (then the last figures are shown).\n"
    "With --plant it shows the boards of the network instead, as their agents report: 6 if one that belongs to a\n"
    "plant is missing. With --board it shows the node of one board.\n"
    "Examples:\n"
    "  indurop status\n"
    "  indurop status -w\n"
    "  indurop status --plant\n"
    "  indurop status --board control\n",
    &declare};

}  // namespace indurop::tools
