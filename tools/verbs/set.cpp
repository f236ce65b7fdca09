// SPDX-License-Identifier: Apache-2.0
// indurop set: writes values once, after all of them were found good.
#include "tools/values/assignment.h"
#include "tools/values/forcing.h"
#include "tools/values/node_choice.h"
#include "tools/verbs/verbs.h"

namespace indurop::tools {
namespace {

int set(Context& context, const std::vector<std::string>& words) {
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
  if (const std::string absence = context.values->absence(&*store); !absence.empty() && context.values->here()) {
    context.out.note(context.values->gone(absence) + ": the values wait for its next start");
  }
  return kOk;
}

Action declare(base::Options& app, Context& context) {
  auto words = std::make_shared<std::vector<std::string>>();
  app.add("assignment", "TEXT", *words, "NAME VALUE, or NAME=VALUE ...")
      .required()
      .completes(base::Completion::Variable);
  add_reason_option(app, context);
  add_node_option(app, context);
  add_far_options(app, context);
  return [words](Context& c) { return set(c, *words); };
}

}  // namespace

const Verb kSetVerb{
    "set", "Variables", "Write variables or parts of them, once",
    "All values are checked before the first is written: type, array bounds, declared range. A declared range is\n"
    "never overridden. Each NAME=VALUE is one commit; write a struct or array as a whole to change several parts\n"
    "at once. A module that writes the same variable overwrites the value in its next run; see\n"
    "indurop force.\n"
    "Examples:\n"
    "  indurop set gain 2.5\n"
    "  indurop set 'joints[1].y=-0.5' mode=AUTO\n"
    "  indurop set 'joints[0]' '{x: 1, y: 2, z: 3}'\n",
    &declare};

}  // namespace indurop::tools
