// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/values/assignment.h"

#include <fmt/format.h>

#include <utility>

#include "control/plc/st/value_literal.h"

namespace indurop::tools {
namespace {

// Returns an empty list after an error message.
std::vector<std::pair<std::string, std::string>> split(Context& context, const char* verb,
                                                       const std::vector<std::string>& words) {
  std::vector<std::pair<std::string, std::string>> out;
  // '=' inside a value (a text in quotes) does not make the first word an assignment.
  if (words.size() == 2 && words[0].find('=') == std::string::npos) {
    return {{words[0], words[1]}};
  }
  for (const std::string& word : words) {
    const auto equals = word.find('=');
    if (equals == std::string::npos || equals == 0) {
      context.out.error(
          fmt::format("'{}' is not an assignment; write: indurop {} NAME VALUE, or NAME=VALUE ...", word, verb));
      return {};
    }
    out.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return out;
}

int parse_one(Context& context, const vars::Store& store, const char* verb, const std::string& name,
              const std::string& text, std::vector<Assignment>& out) {
  std::vector<Item> items;
  if (is_glob(name)) {
    context.out.error(fmt::format("'{}': {} takes names, not globs", name, verb));
    return kFailed;
  }
  if (const int code = select_items(context, store, {name}, items); code != kOk) {
    return code;
  }
  auto assignment = operate::parse(store, std::move(items.front()), text, &plc::read_value_literal);
  if (!assignment) {
    context.out.error(assignment.error().text);
    return kFailed;
  }
  out.push_back(std::move(assignment).value());
  return kOk;
}

}  // namespace

Result<std::vector<Assignment>, Failure> read_assignments(Context& context, const vars::Store& store, const char* verb,
                                                          const std::vector<std::string>& words) {
  const auto pairs = split(context, verb, words);
  if (pairs.empty()) {
    return Failure{kUsage, {}};
  }
  std::vector<Assignment> assignments;
  int code = kOk;
  for (const auto& [name, text] : pairs) {
    const int parsed = parse_one(context, store, verb, name, text, assignments);
    code = parsed != kOk ? parsed : code;
  }
  if (code == kOk) {
    return assignments;
  }
  if (pairs.size() > 1) {
    context.out.note("nothing was changed");
  }
  return Failure{code, {}};
}

}  // namespace indurop::tools
