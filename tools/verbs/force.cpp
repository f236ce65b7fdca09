// SPDX-License-Identifier: Apache-2.0
// indurop force, unforce, forces: values that hold whoever writes them.
#include <fmt/format.h>

#include "rt/clock.h"
#include "tools/command/interrupt.h"
#include "tools/command/units.h"
#include "tools/plant/board_forces.h"
#include "tools/values/assignment.h"
#include "tools/values/force_view.h"
#include "tools/values/forcing.h"
#include "tools/values/node_choice.h"
#include "tools/values/value_source.h"
#include "tools/verbs/verbs.h"

namespace indurop::tools {
namespace {

// Opens the store of a node that runs: forces end with it.
Result<vars::Store, Failure> open_running(Context& context) {
  auto store = open_store(context, vars::Mode::ReadWrite);
  if (store) {
    if (const std::string absence = context.values->absence(&*store); !absence.empty()) {
      return Failure{kUnreachable, context.values->gone(absence) + ": forces are for a node that runs"};
    }
  }
  return store;
}

struct ForceOptions {
  BoardForces board;
  std::vector<std::string> words;
  std::int64_t for_ns = 0;
  bool lease = false;
};

// Until the user ends it, the node ends, or somebody else lets go of one of them.
int keep_holding(Context& context, vars::Store& store, Lease& lease) {
  constexpr std::int64_t kRenewNs = kLeaseNs / 4;
  context.out.note("held while this runs; Ctrl-C lets go");
  int code = kOk;
  while (code == kOk && wait_until(rt::now_ns() + kRenewNs) != Woken::Signal) {
    if (const std::string absence = context.values->absence(&store); store.retired() || !absence.empty()) {
      context.out.error(context.values->gone(absence.empty() ? "started anew" : absence) +
                        ": nothing is held any more");
      code = kUnreachable;
    } else if (!renew(lease, store, kLeaseNs)) {
      context.out.error("somebody else has let one of them go or forced it since; the others are let go");
      code = kFailed;
    }
  }
  take_interrupt();
  end(context, lease, store);
  return code;
}

int force_while_here(Context& context, vars::Store& store, const std::vector<Assignment>& assignments) {
  if (store.header().virtual_ns.load() != 0) {
    context.out.error("the time of a simulation is not the one that --lease goes by: use --for");
    return kUsage;
  }
  Lease lease;
  const int code = hold_values(context, store, assignments, kLeaseNs, &lease);
  return code == kOk ? keep_holding(context, store, lease) : code;
}

int force(Context& context, ForceOptions& options) {
  if (options.lease && options.for_ns > 0) {
    context.out.error("--lease and --for are two ways of ending: choose one");
    return kUsage;
  }
  if (options.board.board.wanted()) {
    return options.lease ? hold_on_board(context, options.board, options.words)
                         : force_on_board(context, options.board, options.words, options.for_ns);
  }
  auto store = open_running(context);
  if (!store) {
    return report(context.out, store.error());
  }
  const auto assignments = read_assignments(context, *store, "force", options.words);
  if (!assignments) {
    return report(context.out, assignments.error());
  }
  return options.lease ? force_while_here(context, *store, *assignments)
                       : hold_values(context, *store, *assignments, options.for_ns);
}

struct UnforceOptions {
  BoardForces board;
  std::vector<std::string> names;
  bool all = false;
};

int unforce(Context& context, UnforceOptions& options) {
  if (options.names.empty() != options.all) {
    context.out.error("name what to release: names, globs, or --all");
    return kUsage;
  }
  if (options.board.board.wanted()) {
    return unforce_on_board(context, options.board, options.names);
  }
  auto store = open_store(context, vars::Mode::ReadWrite);
  if (!store) {
    return report(context.out, store.error());
  }
  std::vector<Item> items;
  if (const int code = options.all ? kOk : select_items(context, *store, options.names, items); code != kOk) {
    return code;
  }
  std::vector<std::string> gone;
  const int code = options.all ? let_all_go(context, *store, gone) : let_values_go(context, *store, items, gone);
  if (code == kOk && gone.empty()) {
    context.out.note("none of these is forced");
  }
  return code;
}

Result<std::vector<ForceView>, Failure> forces_of(Context& context, BoardChoice& board) {
  if (board.wanted()) {
    auto run = open_run(context, board);
    return run ? Result<std::vector<ForceView>, Failure>(run->forces.value_or(std::vector<ForceView>()))
               : std::move(run).error();
  }
  const auto store = open_store(context, vars::Mode::ReadOnly);
  return store ? Result<std::vector<ForceView>, Failure>(view_forces(context.node, *store)) : store.error();
}

int forces(Context& context, BoardChoice& board) {
  const auto all = forces_of(context, board);
  if (!all) {
    return report(context.out, all.error());
  }
  Table table({{"NAME", "name"},
               {"VALUE", "value", Align::Right},
               {"LEFT", "left_ns", Align::Right},
               {"LEASE", "lease"},
               {"WHO", "who"},
               {"REASON", "reason"}});
  for (const ForceView& one : *all) {
    table.add({Cell(one.name), Cell(one.value, one.raw),
               Cell(one.left_ns ? human_age(*one.left_ns) : "until unforced",
                    one.left_ns ? JsonValue(*one.left_ns) : JsonValue(), Style::None),
               Cell(one.note.lease ? "yes" : "", JsonValue(one.note.lease), Style::None),
               Cell(one.note.from.empty() ? one.note.who : fmt::format("{} on {}", one.note.who, one.note.from)),
               Cell(one.note.reason)});
  }
  if (table.empty() && context.format == Format::Table) {
    context.out.note("nothing is forced");
  }
  print_table(context, table, {{"node", board.wanted() ? board.board : context.node}}, "forces");
  return kOk;
}

Action declare_force(base::Options& app, Context& context) {
  auto options = std::make_shared<ForceOptions>();
  app.add("assignment", "TEXT", options->words, "NAME VALUE, or NAME=VALUE ...")
      .required()
      .completes(base::Completion::Variable);
  add_time_option(app, "--for", options->for_ns, "Let go by itself after this time (default: until unforce)");
  app.flag("--lease", options->lease, "Stay, and let go when this command ends: by Ctrl-C, or 2 s after it was killed");
  add_reason_option(app, context);
  add_node_option(app, context);
  add_board_force_options(app, options->board);
  return [options](Context& c) { return force(c, *options); };
}

Action declare_unforce(base::Options& app, Context& context) {
  auto options = std::make_shared<UnforceOptions>();
  app.add("names", "NAME", options->names, "Forced values, or what they are parts of, or globs")
      .completes(base::Completion::Variable);
  app.flag("--all", options->all, "Everything that is forced");
  add_reason_option(app, context);
  add_node_option(app, context);
  add_board_force_options(app, options->board);
  return [options](Context& c) { return unforce(c, *options); };
}

Action declare_forces(base::Options& app, Context& context) {
  auto board = std::make_shared<BoardChoice>();
  add_node_option(app, context);
  add_board_options(app, *board);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [board](Context& c) { return forces(c, *board); };
}

}  // namespace

const Verb kForceVerb{
    "force", "Variables", "Hold values, whoever writes them",
    "What modules, processes, drivers and other boards write to a forced number is dropped, so an\n"
    "input can be simulated and an output be held while the program runs. Programs see the forced\n"
    "value, and boards that mirror the variable do too: force on the board that owns it. Of a struct\n"
    "that is held what the value says; other elements and fields go on. A force ends with unforce,\n"
    "after --for, with this command (--lease), or when the node ends; the value then stays until it is written. "
    "'indurop status' shows what is forced. With --board it is done by the\n"
    "agent of a board anywhere in the network; a board that has keys obeys only who has them too.\n"
    "Examples:\n"
    "  indurop force PLC_ROBOT::I0 true --for 30s\n"
    "  indurop force 'joints[1].y=-0.5' mode=AUTO\n"
    "  indurop force 'joints[1]={x: 1, z: 0}' --lease --reason 'gauge is broken'\n"
    "  indurop force motor_on=false --board control --keys keys\n",
    &declare_force};

const Verb kUnforceVerb{"unforce", "Variables", "Let forced values go",
                        "Examples:\n"
                        "  indurop unforce PLC_ROBOT::I0 'joints[1]'\n"
                        "  indurop unforce --all --board control\n",
                        &declare_unforce};

const Verb kForcesVerb{"forces", "Variables", "List what is forced, and for how long",
                       "Examples:\n"
                       "  indurop forces\n"
                       "  indurop forces --board control\n"
                       "  indurop forces -o csv\n",
                       &declare_forces};

}  // namespace indurop::tools
