// SPDX-License-Identifier: Apache-2.0
// indurop set: writes values once, after all of them were found good.
#include <fmt/format.h>

#include <algorithm>

#include "tools/assignment.h"
#include "tools/far_values.h"
#include "tools/node_choice.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

// One after the other; boards take whole variables.
int set_afar(Context& context, const vars::Store& store, const std::vector<Assignment>& assignments) {
  for (const auto& [item, bytes] : assignments) {
    std::vector<std::uint8_t> whole(item.place.variable->type.size());
    const Status read = store.read(*item.entry, 0, whole);
    if (!read.ok()) {
      context.out.error(fmt::format("{} cannot be read: {}", item.name, read.error().where));
      return kFailed;
    }
    std::copy(bytes.begin(), bytes.end(), whole.begin() + item.place.offset);
    bool timed_out = false;
    const std::string problem = context.far_values->set(item.place.variable->name, whole, timed_out);
    if (!problem.empty()) {
      context.out.error(fmt::format("{} was not set: {}", item.name, problem));
      return timed_out ? kUnreachable : kFailed;
    }
  }
  return kOk;
}

// Writing to a forced value would be for nothing.
bool any_forced(Context& context, const vars::Store& store, const std::vector<Assignment>& assignments) {
  bool any = false;
  for (const vars::Force& force : store.forces()) {
    for (const auto& [item, bytes] : assignments) {
      const std::uint64_t begin = item.place.offset;
      if (force.variable == item.entry && force.offset < begin + bytes.size() && begin < force.offset + force.size) {
        context.out.error(fmt::format("{} is forced; first let it go: indurop unforce '{}'", item.name, item.name));
        any = true;
      }
    }
  }
  return any;
}

int set(Context& context, const std::vector<std::string>& words) {
  int code = kOk;
  auto store = open_store(context, vars::Mode::ReadWrite, code);
  if (!store) {
    return code;
  }
  const auto assignments = read_assignments(context, *store, "set", words, code);
  if (!assignments) {
    return code;
  }
  if (context.far_values != nullptr) {
    return set_afar(context, *store, *assignments);
  }
  if (any_forced(context, *store, *assignments)) {
    return kFailed;
  }
  for (const auto& [item, bytes] : *assignments) {
    const Status written = store->write(*item.entry, item.place.offset, bytes);
    if (!written.ok()) {
      context.out.error(written.error().code == Errc::Busy
                            ? fmt::format("{} is being written by somebody who does not finish; try again", item.name)
                            : fmt::format("{} cannot be written: {} ({})", item.name, written.error().where,
                                          to_string(written.error().code)));
      return written.error().code == Errc::Busy ? kUnreachable : kFailed;
    }
  }
  const std::string absence = store_absence(store->header());
  if (!absence.empty()) {
    context.out.note(fmt::format("node '{}' is {}: the values wait for its next start", context.node, absence));
  }
  return kOk;
}

Action declare(CLI::App& app, Context& context) {
  auto words = std::make_shared<std::vector<std::string>>();
  app.add_option("assignment", *words, "NAME VALUE, or NAME=VALUE ...")->required()->type_name("TEXT");
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
