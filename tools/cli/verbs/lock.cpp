// SPDX-License-Identifier: Apache-2.0
// indurop lock: restricts what may be written to a node from outside.
#include <fmt/format.h>

#include "store/operate/set.h"
#include "tools/cli/plant/board_forces.h"
#include "tools/cli/values/forcing.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/values/force_view.h"

namespace indurop::tools {
namespace {

struct LockOptions {
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
  context.node = node;
  if (const auto locked = operate::set_lock(node, lock, who_orders(context)); !locked) {
    return report(context, locked.error());
  }
  note_for_audit(context, "lock", vars::word_of(lock));
  return kOk;
}

int lock(Context& context, LockOptions& options) {
  const bool remote = options.board.board.wanted();
  if (options.word.empty() && remote) {
    const auto run = open_run(context, options.board.board);
    return run ? show(context, run->node, run->lock) : report(context.out, run.error());
  }
  const auto wanted = vars::write_lock_of(options.word);
  if (!options.word.empty() && !wanted) {
    context.out.error(fmt::format("'{}' is no lock: none, tune or all", options.word));
    return kUsage;
  }
  if (remote) {
    return lock_board(context, options.board, options.word);
  }
  const auto node = choose_node(context.node);
  if (!node) {
    return report(context.out, node.error());
  }
  return wanted ? set_here(context, *node, *wanted) : show(context, *node, vars::lock_of(*node));
}

Action declare_lock(base::Options& app, Context& context) {
  auto options = std::make_shared<LockOptions>();
  app.add("lock", "none|tune|all", options->word, "New lock (default: show the current one)");
  add_reason_option(app, context);
  add_node_option(app, context);
  add_board_force_options(app, options->board);
  add_format_option(app, context, {Format::Table, Format::Json});
  return [options](Context& c) { return lock(c, *options); };
}

}  // namespace

const Verb kLockVerb{
    "lock", "Variables", "Protect a node against accidental writes",
    "none: users who have the rights may set, force, load recipes and stop modules. tune: parameters (variables\n"
    "declared with a value and not @optional) may be set, nothing else. all: nothing may be changed. The lock\n"
    "applies to every tool, the page and commands from the network, until it is changed; it survives a restart\n"
    "of the node, but not of the machine. Modules and boards of the plant continue to write, existing forces\n"
    "stay, and a whole node can be stopped. Every user who may write may also unlock: the lock protects against\n"
    "mistakes, not against people.\n"
    "Examples:\n"
    "  indurop lock tune --reason production\n"
    "  indurop lock none --board control --keys keys\n"
    "  indurop lock\n",
    &declare_lock};

}  // namespace indurop::tools
