// SPDX-License-Identifier: Apache-2.0
// indurop lock: what may be written to a node from outside.
#include <fmt/format.h>

#include "base/user_name.h"
#include "explain/orders.h"
#include "rt/clock.h"
#include "tools/command/audit.h"
#include "tools/plant/board_forces.h"
#include "tools/values/force_view.h"
#include "tools/values/node_choice.h"
#include "tools/verbs/verbs.h"

namespace indurop::tools {
namespace {

struct Options {
  BoardForces board;
  std::string word;
};

int show(Context& context, const std::string& node, const vars::LockNote& lock) {
  JsonValue json = document();
  json["node"] = node;
  json.update(json_of(lock));
  const std::string line = lock_line(lock);
  context.out.line(context.format == Format::Json ? json.dump() : line.empty() ? vars::word_of(lock.lock) : line);
  return kOk;
}

int set_here(Context& context, const std::string& node, vars::WriteLock lock) {
  auto custody = vars::Custody::open(node, vars::Mode::ReadWrite);
  if (!custody) {
    context.out.error(custody.error().code == Errc::NotFound
                          ? fmt::format("node '{}' has not run yet, or was started by an older version", node)
                          : explain_open_error(custody.error(), node, true));
    return exit_code_of(custody.error());
  }
  vars::LockNote note;
  note.who = base::user_name();
  note.reason = context.reason;
  note.wall_ns = rt::wall_ns();
  note.lock = lock;
  if (const Status locked = custody->set_lock(note); !locked) {
    context.out.error(fmt::format("node '{}' is not locked: {}", node, locked.error().where));
    return kUnreachable;
  }
  const std::string word = vars::word_of(lock);
  explain::note_order(node, {rt::now_ns(), 0, {}, {}, "lock", word, {}, 0, context.reason});
  (void)append_audit(usual_audit_file(), {note.wall_ns, note.who, "", node, "lock", word, "done", note.reason});
  return kOk;
}

int lock(Context& context, Options& options) {
  const bool far = options.board.board.wanted();
  if (options.word.empty() && far) {
    const auto run = open_run(context, options.board.board);
    return run ? show(context, run->node, run->lock) : report(context.out, run.error());
  }
  const auto wanted = vars::write_lock_of(options.word);
  if (!options.word.empty() && !wanted) {
    context.out.error(fmt::format("'{}' is no lock: none, tune or all", options.word));
    return kUsage;
  }
  if (far) {
    return lock_board(context, options.board, options.word);
  }
  const auto node = choose_node(context.node);
  if (!node) {
    return report(context.out, node.error());
  }
  return wanted ? set_here(context, *node, *wanted) : show(context, *node, vars::lock_of(*node));
}

Action declare(base::Options& app, Context& context) {
  auto options = std::make_shared<Options>();
  app.add("lock", "none|tune|all", options->word, "What it is from now on; left out: show it");
  add_reason_option(app, context);
  add_node_option(app, context);
  add_board_force_options(app, options->board);
  add_format_option(app, context, {Format::Table, Format::Json});
  return [options](Context& c) { return lock(c, *options); };
}

}  // namespace

const Verb kLockVerb{
    "lock", "Variables", "Keep a node from being written to by accident",
    "none: everybody with the rights to do so may set, force, load recipes and stop modules. tune: parameters\n"
    "(variables declared with a value) may be set, nothing else. all: nothing. The lock holds for every tool, the\n"
    "page and orders from the network, until it is changed; it outlives the node's restart, not that of the machine.\n"
    "Modules and boards of the plant write as ever, forces that are there go on, and a whole node can be stopped.\n"
    "Whoever may write may also unlock: it is against slips, not against people.\n"
    "Examples:\n"
    "  indurop lock tune --reason production\n"
    "  indurop lock none --board control --keys keys\n"
    "  indurop lock\n",
    &declare};

}  // namespace indurop::tools
