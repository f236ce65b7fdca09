// SPDX-License-Identifier: Apache-2.0
// indurop nodes (ps): one line per node of this machine, running or not.
#include <fmt/format.h>

#include <algorithm>

#include "config/xml/reader.h"
#include "tools/command/units.h"
#include "tools/values/node_choice.h"
#include "tools/values/run_report.h"
#include "tools/verbs/verbs.h"

namespace indurop::tools {
namespace {

Cell number(std::uint64_t value, Style if_any = Style::None) {
  return {std::to_string(value), value, value > 0 ? if_any : Style::None};
}

std::vector<Cell> row(const NodeReport& report) {
  const std::string period =
      report.basic_period_ns > 0 ? base::format_duration(base::Nanos(report.basic_period_ns)) : "-";
  return {Cell(report.node, Style::Bold),
          Cell(report.state, report.alive ? Style::Good : Style::Dim),
          {report.alive ? std::to_string(report.pid) : "-", report.alive ? JsonValue(report.pid) : JsonValue()},
          {report.uptime_ns > 0 ? human_age(report.uptime_ns) : "-", report.uptime_ns},
          number(report.modules),
          {period, report.basic_period_ns},
          number(report.ticks),
          number(report.lost_ticks, Style::Warn),
          number(report.overruns, Style::Warn),
          number(report.faults, Style::Bad),
          {report.rt.fifo != 0 ? "yes" : "no", report.rt.fifo != 0, report.rt.fifo != 0 ? Style::None : Style::Warn},
          Cell(report.config_file)};
}

// A node without run block: killed while it started, or its block is of another version.
NodeReport without_run_block(const std::string& node, const Error& error) {
  NodeReport report;
  report.node = node;
  report.state = error.code == Errc::NotFound ? "not running" : to_string(error.code);
  const auto store = vars::Store::attach(node, vars::Mode::ReadOnly);
  if (store.ok() && store_alive(store.value().header())) {
    report.alive = true;
    report.state = "starting";
    report.pid = store.value().header().node_pid.load(std::memory_order_relaxed);
  }
  return report;
}

int nodes(Context& context, bool names_only) {
  constexpr Align kRight = Align::Right;
  Table table({{"NODE", "node"},
               {"STATE", "state"},
               {"PID", "pid", kRight},
               {"UP", "uptime_ns", kRight},
               {"MODULES", "modules", kRight},
               {"BASIC", "basic_period_ns", kRight},
               {"TICK", "ticks", kRight},
               {"LOST", "lost_ticks", kRight},
               {"OVERRUNS", "overruns", kRight},
               {"FAULTS", "faults", kRight},
               {"FIFO", "fifo"},
               {"CONFIGURATION", "config_file"}});
  for (const std::string& node : vars::list_nodes()) {
    if (names_only) {
      context.out.line(node);
      continue;
    }
    const auto run = RunView::open(node);
    table.add(row(run.ok() ? report_of(node, run.value()) : without_run_block(node, run.error())));
  }
  if (names_only) {
    return kOk;
  }
  if (table.empty()) {
    context.out.note("no node on this machine");
  }
  print_table(context, table, JsonValue::object(), "nodes");
  return kOk;
}

Action declare(base::Options& app, Context& context) {
  auto names = std::make_shared<bool>(false);
  app.flag("--names", *names, "Print nothing but the names");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [names](Context& c) { return nodes(c, *names); };
}

}  // namespace

const Verb kNodesVerb{
    "nodes", "A running node", "List the nodes of this machine (also: indurop ps)",
    "A node that does not run is listed as long as it left values behind; indurop clean removes them.\n", &declare};

}  // namespace indurop::tools
