// SPDX-License-Identifier: Apache-2.0
// indurop set: writes values once, after all of them were checked.
#include <fmt/format.h>

#include "deploy/link/link_keys.h"
#include "tools/cli/plant/board_forces.h"
#include "tools/cli/values/assignment.h"
#include "tools/cli/values/forcing.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/known_uses.h"
#include "tools/client/node/node_choice.h"

namespace indurop::tools {
namespace {

struct SetOptions {
  std::vector<std::string> words;
  BoardForces board;
};

// The options for variables that boards show are also those for agents.
int set_by_agent(Context& context, SetOptions& options) {
  deploy::LinkSettings& link = options.board.board.link;
  const dds::NetworkSettings& remote = context.remote.network;
  link.network.domain = remote.domain != 0 ? remote.domain : deploy::LinkSettings::kDefaultDomain;
  link.network.interface_name = remote.interface_name;
  link.network.one_host = remote.one_host;
  link.keys = context.remote.keys;
  if (!link.keys.empty()) {
    if (const auto done = deploy::use_keys(link); !done) {
      context.out.error(done.error().text);
      return kUsage;
    }
  }
  return set_on_board(context, options.board, options.words);
}

// A value that a module also writes does not remain: names the modules, and the command that holds it.
void note_writers(Context& context, const std::vector<Assignment>& assignments) {
  const KnownUses uses = known_uses(context.node);
  for (const Assignment& each : assignments) {
    const auto use = uses.find(each.item.place.variable->name);
    if (use != uses.end() && !use->second.writers.empty()) {
      context.out.note(
          fmt::format("{} is written by {} too, which may overwrite the value in the next run; to hold it: "
                      "indurop force {}={}",
                      use->first, fmt::join(use->second.writers, ", "), each.item.name, each.text));
    }
  }
}

int set(Context& context, SetOptions& options) {
  if (options.board.board.wanted()) {
    return set_by_agent(context, options);
  }
  const std::vector<std::string>& words = options.words;
  std::vector<std::string> names;
  for (const std::string& word : words) {
    names.push_back(word.substr(0, word.find('=')));
  }
  names.resize(words.size() == 2 && names[1] == words[1] ? 1 : names.size());  // NAME VALUE
  auto store = open_store(context, vars::Mode::ReadWrite, names);
  if (!store) {
    return report(context.out, store.error());
  }
  const auto assignments = read_assignments(context, *store, "set", words);
  if (!assignments) {
    return report(context.out, assignments.error());
  }
  if (any_forced(context, *store, *assignments)) {
    return kFailed;
  }
  if (const int code = set_values(context, *store, *assignments); code != kOk) {
    return code;
  }
  if (context.values->here()) {
    note_writers(context, *assignments);
  }
  if (const std::string absence = context.values->absence(&*store); !absence.empty() && context.values->here()) {
    context.out.note(context.values->gone(absence) + ": the values wait for its next start");
  }
  return kOk;
}

Action declare_set(base::Options& app, Context& context) {
  auto options = std::make_shared<SetOptions>();
  app.add("assignment", "TEXT", options->words, "NAME VALUE, or NAME=VALUE ...")
      .required()
      .completes(base::Completion::Variable);
  add_reason_option(app, context);
  add_node_option(app, context);
  add_remote_options(app, context);
  app.add("--board", "NAME", options->board.board.board,
          "Use the agent of this board, which can set any variable; --domain is then that of the agents (default: 76)");
  return [options](Context& c) { return set(c, *options); };
}

}  // namespace

const Verb kSetVerb{
    "set", "Variables", "Write variables or parts of them, once",
    "All values are checked before the first is written: type, array bounds, declared range. A declared range is\n"
    "never overridden. Each NAME=VALUE is one commit; to change several parts at once, write the whole struct or\n"
    "array. If a module writes the same variable, it overwrites the value in its next run; the message then names\n"
    "the module. Use indurop force to hold a value. With --remote, only variables that a board offers for writing\n"
    "(external=\"write\") can be set; with --board, the agent can set any variable, as with indurop force --board.\n"
    "Examples:\n"
    "  indurop set gain 2.5\n"
    "  indurop set 'joints[1].y=-0.5' mode=AUTO\n"
    "  indurop set 'joints[0]' '{x: 1, y: 2, z: 3}'\n"
    "  indurop set gain=2.5 --board control --keys keys\n",
    &declare_set};

}  // namespace indurop::tools
