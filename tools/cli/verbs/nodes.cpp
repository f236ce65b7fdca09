// SPDX-License-Identifier: Apache-2.0
// indurop nodes (ps): one line per node that runs on this machine; with --all also nodes that left values behind.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "config/xml/reader.h"
#include "store/vars/node_lock.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/node/run_report.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

Cell number(std::uint64_t value, Style if_any = Style::None) {
  return {std::to_string(value), value, value > 0 ? if_any : Style::None};
}

std::vector<Cell> row(const NodeReport& report) {
  const std::string period =
      report.basic_period_ns > 0 ? base::format_duration(base::Nanos(report.basic_period_ns)) : "-";
  return {Cell(report.node, Style::Bold),
          Cell(report.state, !report.alive   ? Style::Dim
                             : report.hung() ? Style::Bad
                                             : Style::Good),
          {report.alive ? std::to_string(report.pid) : "-", report.alive ? JsonValue(report.pid) : JsonValue()},
          {report.uptime_ns > 0 ? human_age(report.uptime_ns) : "-", report.uptime_ns},
          number(report.modules),
          {period, report.basic_period_ns},
          number(report.ticks),
          number(report.lost_ticks, Style::Warn),
          number(report.overruns, Style::Warn),
          number(report.faults, Style::Bad),
          {report.rt.fifo != 0 ? "yes" : "no", report.rt.fifo != 0, report.rt.fifo != 0 ? Style::None : Style::Warn},
          Cell(report.owner, report.foreign ? Style::Warn : Style::None),
          Cell(report.config_file)};
}

// Returns the report of a node without run block: killed while it started, or its block is of another version.
NodeReport without_run_block(const std::string& node, const Error& error) {
  NodeReport report;
  report.node = node;
  report.state = error.code == Errc::NotFound ? "not running" : to_string(error.code);
  report.pid = vars::running_node(node);
  if (report.pid != 0) {
    report.alive = true;
    report.state = error.code == Errc::NotFound && !vars::owner_of(node) ? "files removed" : "starting";
  }
  set_owner(report);
  return report;
}

int nodes(Context& context, bool names_only, bool all) {
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
               {"OWNER", "owner"},
               {"CONFIGURATION", "config_file"}});
  std::vector<NodeReport> ended;
  const auto listed = vars::list_nodes(all ? vars::Nodes::All : vars::Nodes::Near);
  for (const std::string& node : listed) {
    if (names_only) {
      context.out.line(node);
      continue;
    }
    const auto run = RunView::open(node);
    NodeReport report = run.ok() ? report_of(node, run.value()) : without_run_block(node, run.error());
    if (report.alive) {
      table.add(row(report));
    } else {
      ended.push_back(std::move(report));
    }
  }
  if (names_only) {
    return kOk;
  }
  if (all) {
    for (const NodeReport& report : ended) {
      table.add(row(report));
    }
  }
  if (table.empty()) {
    context.out.note("no node runs on this machine");
  }
  if (const std::size_t others = vars::list_nodes(vars::Nodes::All).size() - listed.size(); others > 0) {
    context.out.note(fmt::format("{} of other users, left out: shown by --all", others));
  }
  print_table(context, table, JsonValue::object(), "nodes");
  if (!all && !ended.empty()) {
    std::vector<std::string> names;
    std::transform(ended.begin(), ended.end(), std::back_inserter(names),
                   [](const auto& report) { return report.node; });
    context.out.note(fmt::format("ended, but left values behind: {} (shown by --all, removed by indurop clean)",
                                 fmt::join(names, ", ")));
  }
  return kOk;
}

Action declare_nodes(base::Options& app, Context& context) {
  auto names = std::make_shared<bool>(false);
  auto all = std::make_shared<bool>(false);
  app.flag("--all", *all, "Also list nodes that ended and left values behind, and nodes of other users");
  app.flag("--names", *names, "Print only the names");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [names, all](Context& c) { return nodes(c, *names, *all); };
}

}  // namespace

const Verb kNodesVerb{
    "nodes", "A running node", "List the nodes that run on this machine (also: indurop ps)",
    "Nodes that ended and left values behind are listed with --all; indurop clean removes what they left.\n"
    "Nodes of users who are neither root nor share a group with you are listed with --all only.\n"
    "Examples:\n"
    "  indurop nodes\n"
    "  indurop nodes --all -o json\n",
    &declare_nodes};

}  // namespace indurop::tools
