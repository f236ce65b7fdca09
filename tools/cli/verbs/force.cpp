// SPDX-License-Identifier: Apache-2.0
// indurop force, unforce, forces: values that hold against all writers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/rt/clock.h"
#include "store/operate/hold.h"
#include "tools/cli/plant/board_forces.h"
#include "tools/cli/values/assignment.h"
#include "tools/cli/values/forcing.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"
#include "tools/client/values/force_view.h"
#include "tools/client/values/value_source.h"

namespace indurop::tools {
namespace {

// Opens the store of a running node: forces end with the node.
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

// Time of a lease after its last renewal.
constexpr std::int64_t kLeaseNs = 2'000'000'000;

// Holds until the user ends it, the node ends, or another user releases one of them.
int keep_holding(Context& context, vars::Store& store, operate::Lease& lease) {
  constexpr std::int64_t kRenewNs = kLeaseNs / 4;
  context.out.note("held while this command runs; Ctrl-C releases");
  int code = kOk;
  while (code == kOk && wait_until(rt::now_ns() + kRenewNs) != Woken::Signal) {
    if (const std::string absence = context.values->absence(&store); store.retired() || !absence.empty()) {
      context.out.error(context.values->gone(absence.empty() ? "started again" : absence) +
                        ": nothing is held any more");
      code = kUnreachable;
    } else if (const auto renewed = operate::renew(lease, store, kLeaseNs); !renewed) {
      code = report(context, renewed.error());
    }
  }
  take_interrupt();
  std::string names = fmt::format("{}", fmt::join(lease.names, " "));
  operate::end(context.node, store, lease, who_orders(context));
  note_for_audit(context, "unforce", names);
  return code;
}

int hold(Context& context, vars::Store& store, const ForceOptions& options,
         const std::vector<Assignment>& assignments) {
  auto held = operate::hold(context.node, store, assignments, options.lease ? kLeaseNs : options.for_ns,
                            options.lease ? operate::Ends::UnlessRenewed : operate::Ends::AtTime, who_orders(context));
  if (!held) {
    return report(context, held.error());
  }
  note_for_audit(context, "force", text_of(assignments));
  return options.lease ? keep_holding(context, store, *held) : kOk;
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
  if (options.lease && store->header().virtual_ns.load() != 0) {
    context.out.error("the time of a simulation is not the one that --lease goes by: use --for");
    return kUsage;
  }
  return hold(context, *store, options, *assignments);
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
  const operate::Who who = who_orders(context);
  const auto released = options.all ? operate::release_all(context.node, *store, who)
                                    : operate::release(context.node, *store, items, who);
  if (!released) {
    return report(context, released.error());
  }
  if (released->empty()) {
    context.out.note("none of these is forced");
  } else {
    note_for_audit(context, "unforce", fmt::format("{}", fmt::join(*released, " ")));
  }
  return kOk;
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
  add_time_option(app, "--for", options->for_ns, "Release after this time (default: hold until unforce)");
  app.flag("--lease", options->lease,
           "Keep running, and release when this command ends: on Ctrl-C, or 2 s after it is killed");
  add_reason_option(app, context);
  add_node_option(app, context);
  add_board_force_options(app, options->board);
  return [options](Context& c) { return force(c, *options); };
}

Action declare_unforce(base::Options& app, Context& context) {
  auto options = std::make_shared<UnforceOptions>();
  app.add("names", "NAME", options->names, "Forced values, variables that contain them, or globs")
      .completes(base::Completion::Variable);
  app.flag("--all", options->all, "Release everything that is forced");
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
    "force", "Variables", "Hold values against all writers",
    "Values that modules, processes, drivers and other boards write to a forced number are discarded. So you can\n"
    "simulate an input or hold an output while the program runs. Programs see the forced value, and so do boards\n"
    "that mirror the variable: force it on the board that owns it. In a struct, only the elements and fields that\n"
    "the value names are held; the others continue to change. A force ends with unforce, after --for, with this\n"
    "command (--lease), or when the node ends; the value then stays until it is written. 'indurop status' shows\n"
    "what is forced. With --board, the agent of a board anywhere in the network forces the value; a secured board\n"
    "accepts commands only from clients with its keys.\n"
    "Examples:\n"
    "  indurop force PLC_ROBOT::I0 true --for 30s\n"
    "  indurop force 'joints[1].y=-0.5' mode=AUTO\n"
    "  indurop force 'joints[1]={x: 1, z: 0}' --lease --reason 'gauge is broken'\n"
    "  indurop force motor_on=false --board control --keys keys\n",
    &declare_force};

const Verb kUnforceVerb{"unforce", "Variables", "Release forced values",
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
