// SPDX-License-Identifier: Apache-2.0
// indurop set: writes values once, after all of them were found good.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "tools/far_values.h"
#include "tools/node_choice.h"
#include "tools/variables.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

struct Assignment {
  Item item;
  std::vector<std::uint8_t> bytes;
};

// "a=1" "b=2", or "a" "1". Empty after an error message.
std::vector<std::pair<std::string, std::string>> split(Context& context, const std::vector<std::string>& words) {
  std::vector<std::pair<std::string, std::string>> out;
  // '=' inside a value (a text in quotes) does not make the first word an assignment.
  if (words.size() == 2 && words[0].find('=') == std::string::npos) {
    return {{value_of(words[0]), value_of(words[1])}};
  }
  for (const std::string& marked : words) {
    const std::string word = value_of(marked);
    const auto equals = word.find('=');
    if (equals == std::string::npos || equals == 0) {
      context.out.error(fmt::format("'{}' is no assignment; write: indurop set NAME VALUE, or NAME=VALUE ...", word));
      return {};
    }
    out.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return out;
}

bool parse_one(Context& context, const vars::Store& store, const std::string& name, const std::string& text,
               std::vector<Assignment>& out) {
  std::vector<Item> items;
  if (is_glob(name)) {
    context.out.error(fmt::format("'{}': set takes names, no globs", name));
    return false;
  }
  if (!select_items(context, store, {name}, items)) {
    return false;
  }
  Assignment assignment{items.front(), std::vector<std::uint8_t>(items.front().place.type.size())};
  const auto& place = assignment.item.place;
  // Parts of a value that are not mentioned keep what they have.
  std::string problem;
  assignment.bytes = read_item(store, assignment.item, problem);
  std::string message;
  const Status parsed = schema::parse_value(place.type, text, assignment.bytes, message);
  if (!parsed.ok()) {
    context.out.error(
        fmt::format("{}: {}", assignment.item.name,
                    message.empty() ? fmt::format("'{}' is no {}", text, schema::display_name(place.type)) : message));
    return false;
  }
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  const schema::Range range = place.range.value_or(schema::Range{-kUnlimited, kUnlimited});
  const Status in_range = schema::check_range(range, place.type, assignment.bytes, message);
  if (!in_range.ok()) {
    context.out.error(fmt::format("{}: {}", assignment.item.name, message));
    return false;
  }
  out.push_back(std::move(assignment));
  return true;
}

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

int set(Context& context, const std::vector<std::string>& words) {
  const auto pairs = split(context, words);
  if (pairs.empty()) {
    return kUsage;
  }
  int code = kOk;
  auto store = open_store(context, vars::Mode::ReadWrite, code);
  if (!store) {
    return code;
  }
  std::vector<Assignment> assignments;
  bool good = true;
  for (const auto& [name, text] : pairs) {
    good = parse_one(context, *store, name, text, assignments) && good;
  }
  if (!good) {
    if (pairs.size() > 1) {
      context.out.note("nothing was changed");
    }
    return kFailed;
  }
  if (context.far_values != nullptr) {
    return set_afar(context, *store, assignments);
  }
  for (const auto& [item, bytes] : assignments) {
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
    "at once. A module that writes the same variable overwrites the value in its next run.\n"
    "Examples:\n"
    "  indurop set gain 2.5\n"
    "  indurop set 'joints[1].y=-0.5' mode=AUTO\n"
    "  indurop set 'joints[0]' '{x: 1, y: 2, z: 3}'\n",
    &declare};

}  // namespace indurop::tools
