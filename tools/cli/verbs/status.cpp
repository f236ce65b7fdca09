// SPDX-License-Identifier: Apache-2.0
// indurop status: the state of the node, its real-time privileges, and the state of its modules.
#include <fmt/format.h>

#include "core/rt/clock.h"
#include "history/alarms/alarm_journal.h"
#include "history/alarms/alarm_list.h"
#include "history/alarms/declared_alarms.h"
#include "store/vars/retain.h"
#include "tools/cli/command/repeat.h"
#include "tools/cli/plant/board_run.h"
#include "tools/cli/plant/plant_status.h"
#include "tools/cli/values/status_lines.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/external_view.h"
#include "tools/client/node/mirror_view.h"
#include "tools/client/node/module_reload.h"
#include "tools/client/node/module_table.h"
#include "tools/client/node/node_trouble.h"
#include "tools/client/node/pool_program.h"
#include "tools/client/node/pool_view.h"
#include "tools/client/node/run_report.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"
#include "tools/client/values/force_view.h"

namespace indurop::tools {
namespace {

std::vector<ForceView> forces_here(const std::string& node) {
  const auto store = vars::Store::attach(node, vars::Mode::ReadOnly);
  return store ? view_forces(node, *store) : std::vector<ForceView>();
}

std::vector<PoolView> pools_here(const std::string& node) {
  const auto store = vars::Store::attach(node, vars::Mode::ReadOnly);
  return store ? view_pools(node, *store) : std::vector<PoolView>();
}

alarms::AlarmCounts alarms_here(const std::string& node) {
  alarms::AlarmJournal journal(node);
  journal.refresh();
  return journal.book().counts();
}

// Returns a line if the node declares alarms whose conditions no process evaluates, else an empty text.
std::string unwatched_alarms(const std::string& node) {
  const auto store = vars::Store::attach(node, vars::Mode::ReadOnly);
  const bool unwatched = store && !alarms::declared_alarms(*store).empty() && !alarms::AlarmJournal(node).watched();
  return unwatched ? "no process is evaluating the declared alarms: run indurop-agent, indurop serve, or indurop "
                     "alarms watch"
                   : "";
}

// What `indurop status` shows of a node besides the table of modules.
struct StatusHead {
  NodeReport report;
  std::optional<MirrorView> mirror;
  std::optional<ExternalView> external;
  std::vector<std::string> retained;
  alarms::AlarmCounts alarms;
  std::vector<ForceView> forces;
  vars::LockNote lock;
  std::vector<std::string> trouble;
  std::vector<PoolView> pools;
  std::optional<PoolProgram> pool_program;
  std::vector<std::string> exchanged;  // modules whose code was exchanged, with their version
};

std::vector<std::string> exchanged_modules(const RunView& run) {
  std::vector<std::string> lines;
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    if (const std::string version = version_text(run.module(i)); !version.empty()) {
      lines.push_back(fmt::format("{}: {}", printable(fixed_text(run.module(i).name)), version));
    }
  }
  return lines;
}

StatusHead read_head(const BoardRun& chosen) {
  const std::string& node = chosen.node;
  const RunView& run = chosen.run;
  StatusHead head{report_of(node, run), {}, {}, {}, {}, {}, {}, {}, {}, {}, exchanged_modules(run)};
  if (run.here()) {
    head.mirror = view_mirror(node);
    head.external = view_external(node);
    head.retained = vars::RetainFile(vars::state_directory(node)).last_report();
    head.alarms = alarms_here(node);
    head.pools = pools_here(node);
    head.pool_program = view_pool_program(node);
  }
  head.forces = chosen.forces ? *chosen.forces : forces_here(node);
  head.lock = chosen.forces ? chosen.lock : vars::lock_of(node);
  head.trouble = trouble_now(run, head.mirror);
  if (head.pool_program && !head.pool_program->problem.empty()) {
    head.trouble.push_back(printable(head.pool_program->problem));
  }
  if (const std::string text = run.here() && head.report.alive ? unwatched_alarms(node) : ""; !text.empty()) {
    head.trouble.push_back(text);
  }
  return head;
}

void print_head(Context& context, const StatusHead& head) {
  const auto warn = [&context](const std::string& text) {
    context.out.line(context.out.paint(Style::Warn, "  " + text));
  };
  for (const std::string& line : header_lines(head.report, context.out)) {
    context.out.line(line);
  }
  for (const std::string& text : head.trouble) {
    context.out.line(context.out.paint(Style::Bad, "  wrong     " + text));
  }
  if (!head.forces.empty()) {
    warn("forced    " + force_line(head.forces));
  }
  if (const std::string text = lock_line(head.lock); !text.empty()) {
    warn("locked    " + text);
  }
  if (const std::string text = alarms::sentence_of(head.alarms); !text.empty()) {
    warn(fmt::format("alarms    {} (indurop alarms)", text));
  }
  for (const std::string& one : head.retained) {
    warn("retained  " + one);
  }
  for (const std::string& one : head.exchanged) {
    context.out.line("  exchanged " + one);
  }
  for (const PoolView& pool : head.pools) {
    const std::vector<std::string> lines = lines_of(pool);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      context.out.line((i == 0 ? "  pool      " : "            ") + lines[i]);
    }
  }
  if (head.pool_program) {
    context.out.line("  pools     " + line_of(*head.pool_program));
  }
  if (head.mirror) {
    for (const std::string& line : mirror_lines(*head.mirror, context.out)) {
      context.out.line(line);
    }
  }
  if (head.external) {
    for (const std::string& line : external_lines(*head.external, context.out)) {
      context.out.line(line);
    }
  }
  context.out.line();
}

int show_once(Context& context, const BoardRun& chosen, bool check) {
  StatusHead head = read_head(chosen);
  if (context.format == Format::Table) {
    print_head(context, head);
  }
  if (head.alarms.active + head.alarms.unacknowledged > 0) {
    head.trouble.push_back(alarms::sentence_of(head.alarms));
  }
  JsonValue json = json_of(head.report);
  json["mirror"] = head.mirror ? json_of(*head.mirror) : JsonValue();
  json["forces"] = json_of(head.forces);
  json["lock"] = json_of(head.lock);
  json["alarms"] = json_of(head.alarms);
  json["pools"] = json_of(head.pools);
  json["pool_program"] = json_of(head.pool_program);
  json["trouble"] = JsonValue(head.trouble);
  json["retain_lost"] = head.retained;
  json["external"] = head.external ? json_of(*head.external) : JsonValue();
  print_table(context, module_table(chosen.run, head.report.alive), json, "modules");
  if (!head.report.alive && !chosen.kept) {
    return kUnreachable;
  }
  return check && !head.trouble.empty() ? kCheckFailed : kOk;
}

Action declare_status(base::Options& app, Context& context) {
  auto repeat = std::make_shared<Repeat>();
  auto plant = std::make_shared<PlantStatus>();
  auto board = std::make_shared<BoardChoice>();
  auto check = std::make_shared<bool>(false);
  app.flag("--check", *check, "Exit code 4 if something is wrong now: a module, another board, or an alarm");
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  add_repeat_options(app, *repeat);
  app.flag("--plant", plant->wanted,
           "Show all boards of the network, from any machine; boards that do not report are named");
  deploy::add_link_options(app, board->link);
  add_board_options(app, *board, false);
  add_kept_option(app, *board);
  return [repeat, plant, board, check](Context& c) {
    plant->link = board->link;
    plant->check = *check;
    return repeat_rounds(c, *repeat, [&c, &plant, &board, &check] {
      if (plant->wanted) {
        return plant->show(c);
      }
      const auto chosen = open_run(c, *board);
      return chosen ? show_once(c, *chosen, *check) : report(c.out, chosen.error());
    });
  };
}

}  // namespace

const Verb kStatusVerb{
    "status", "A running node", "Show the state of the node and its modules",
    "EXEC is the execution time of run(), JITTER |J_n|: how far a start was from its place on the time grid. A\n"
    "state in brackets is the last one of a node that has ended. On a narrow terminal some columns are omitted.\n"
    "Exit code 0 if the node runs, 6 if it does not (its last values are then shown). With --check it is 4 if the\n"
    "node runs and something is wrong now (lines 'wrong'): a module is stopped, faulted or has not started,\n"
    "another board is missing, or an alarm is active or not acknowledged. Past overruns, lost ticks and faults\n"
    "are ignored.\n"
    "With --plant it shows the boards of the network instead, as their agents report them. The exit code is then\n"
    "6 if a board that belongs to a plant is missing; with --check it is 4 if a node does not run or has alarms.\n"
    "With --board it shows the node of one board.\n"
    "Examples:\n"
    "  indurop status\n"
    "  indurop status -w\n"
    "  indurop status --check\n"
    "  indurop status --plant\n"
    "  indurop status --board control\n",
    &declare_status};

}  // namespace indurop::tools
