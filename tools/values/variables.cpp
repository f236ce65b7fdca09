// SPDX-License-Identifier: Apache-2.0
#include "tools/values/variables.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tools/command/units.h"
#include "tools/values/node_choice.h"
#include "tools/values/value_source.h"

namespace indurop::tools {
namespace {

bool add_item(const vars::Store& store, std::string name, const schema::Place& place, std::vector<Item>& items) {
  const auto* entry = store.find(place.variable->name_hash());
  if (entry == nullptr) {
    return false;
  }
  const bool known = std::any_of(items.begin(), items.end(), [&](const Item& item) {
    return item.entry == entry && item.place.offset == place.offset && item.name == name;
  });
  if (!known) {
    items.push_back({std::move(name), place, entry});
  }
  return true;
}

schema::Place whole(const schema::Variable& variable) {
  return {&variable, variable.type, 0, variable.unit, variable.range};
}

// Full name of a part that was named without its leading namespaces.
std::string full_name(const std::string& text, const schema::Place& place) {
  const std::string& variable = place.variable->name;
  // The variable's last part ends where an index or a field begins.
  const auto last = variable.rfind("::");
  const std::string base = last == std::string::npos ? variable : variable.substr(last + 2);
  std::size_t at = text.find(base);
  while (at != std::string::npos) {
    const std::size_t end = at + base.size();
    const bool starts = at == 0 || text[at - 1] == ':' || text[at - 1] == '.';
    if (starts && (end == text.size() || text[end] == '[' || text[end] == '.')) {
      return variable + text.substr(end);
    }
    at = text.find(base, at + 1);
  }
  return variable;
}

// Exit code, after an error message: there is no such variable, or its board cannot be asked.
int unknown(Context& context, const std::string& name, const std::string& message) {
  const std::string owner = context.values->silent_owner(name);
  context.out.error(owner.empty() ? message : fmt::format("'{}' is of board {}, which is silent", name, owner));
  return owner.empty() ? kFailed : kUnreachable;
}

// "NAME@BOARD" is taken apart. The exit code, after an error message.
int take_board(Context& context, const vars::Store& store, std::string& name, std::string& board) {
  const auto at = name.rfind('@');
  if (context.values->here() || at == std::string::npos) {
    return kOk;
  }
  board = name.substr(at + 1);
  name.resize(at);
  std::string pattern = name;
  if (!is_glob(name)) {
    std::string message;
    const auto place = schema::find_place(store.schema(), name, message);
    pattern = place.ok() ? place.value().variable->name : name;
  }
  const std::string problem = context.values->prefer(pattern, board);
  return problem.empty() ? kOk : unknown(context, name, problem);
}

// Leaves out what the keys do not let be read. False if that were all.
bool drop_forbidden(Context& context, std::vector<Item>& items) {
  std::set<std::string> forbidden;
  std::erase_if(items, [&](const Item& item) {
    const std::string& variable = item.place.variable->name;
    return context.values->forbidden(variable) && (forbidden.insert(variable), true);
  });
  if (forbidden.empty()) {
    return true;
  }
  const std::string text =
      fmt::format("the keys given by --keys do not let {} be read (indurop keys list -o json shows their lists)",
                  fmt::join(forbidden, ", "));
  items.empty() ? context.out.error(text) : context.out.note(text);
  return !items.empty();
}

}  // namespace

int select_items(Context& context, const vars::Store& store, const std::vector<std::string>& names,
                 std::vector<Item>& items, Values values) {
  int code = kOk;
  for (std::string name : names) {
    std::string board;
    if (const int refused = take_board(context, store, name, board); refused != kOk) {
      code = refused;
      continue;
    }
    if (!is_glob(name)) {
      std::string message;
      const auto place = schema::find_place(store.schema(), name, message);
      if (!place.ok() || !add_item(store, full_name(name, place.value()), place.value(), items)) {
        code = unknown(context, name, message.empty() ? fmt::format("there is no variable '{}'", name) : message);
      }
      continue;
    }
    bool any = false;
    for (const auto& variable : store.schema().variables) {
      const bool meant = board.empty() || context.values->owner(variable.name) == board;
      if (meant && schema::glob_match(name, variable.name)) {
        any = add_item(store, variable.name, whole(variable), items) || any;
      }
    }
    if (!any) {
      context.out.error(
          fmt::format("no variable of {} matches '{}' (indurop vars lists all)", context.values->whose(), name));
      code = kFailed;
    }
  }
  if (code == kOk && values == Values::Needed) {
    std::set<std::string> variables;
    for (const Item& item : items) {
      variables.insert(item.place.variable->name);
    }
    if (const auto missing = context.values->follow(variables); !missing.empty()) {
      context.out.note(
          fmt::format("no value heard of {} within {}", fmt::join(missing, ", "), human_age(context.far.wait_ns)));
    }
    code = drop_forbidden(context, items) ? kOk : kFailed;
  }
  return code;
}

Result<std::vector<std::uint8_t>, base::Problem> read_item(const vars::Store& store, const Item& item) {
  std::vector<std::uint8_t> bytes(item.place.type.size());
  const Status status = store.read(*item.entry, item.place.offset, bytes);
  if (!status.ok()) {
    return base::Problem{
        fmt::format("{} cannot be read: {} ({})", item.name, status.error().where, to_string(status.error().code))};
  }
  return bytes;
}

JsonValue raw_value(const schema::Type& type, std::span<const std::uint8_t> bytes) {
  return JsonValue::parse(schema::value_to_json(type, bytes)).value_or(JsonValue());
}

std::string range_text(const std::optional<schema::Range>& range) {
  if (!range) {
    return {};
  }
  const auto end = [](double value) { return std::isinf(value) ? std::string() : fmt::format("{}", value); };
  return end(range->min) + ".." + end(range->max);
}

std::shared_ptr<const std::vector<std::string>> add_items_to_show(base::Options& app, Context& context) {
  auto names = std::make_shared<std::vector<std::string>>();
  app.add("names", "NAME", *names, "Variables, parts of them (joints[1].y) or globs ('knu::*')")
      .required()
      .completes(base::Completion::Variable);
  add_node_option(app, context);
  add_far_options(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return names;
}

}  // namespace indurop::tools
