// SPDX-License-Identifier: Apache-2.0
// indurop get: prints values of variables or parts of them, once.
#include <fmt/format.h>

#include <set>

#include "tools/cli/values/items_to_show.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/mirror_view.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/node/pool_view.h"
#include "tools/client/values/variables.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kAlignedValue = 24;

// Values of a board that has just died look valid until its lease is over.
void note_old(Context& context, const std::vector<Item>& items) {
  const auto mirror = context.values->here() ? view_mirror(context.node) : std::nullopt;
  std::set<std::string> names;
  for (const Item& item : items) {
    names.insert(item.place.variable->name);
  }
  for (const std::string& line : mirror ? explain_old(*mirror, names) : std::vector<std::string>()) {
    context.out.note(line);
  }
}

// Chunks have no place in a terminal: of a pool it shows how it is used.
int show_pools(Context& context, const std::vector<PoolView>& pools) {
  if (context.format == Format::Json) {
    JsonValue json = document();
    json["node"] = context.values->title();
    json["pools"] = json_of(pools);
    context.out.line(json.dump_rows());
    return kOk;
  }
  for (const PoolView& pool : pools) {
    const std::vector<std::string> lines = lines_of(pool);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      context.out.line((i == 0 ? "" : "  ") + lines[i]);
    }
  }
  return kOk;
}

int get(Context& context, const std::vector<std::string>& names) {
  const auto store = open_store(context, vars::Mode::ReadOnly, names);
  if (!store) {
    return report(context.out, store.error());
  }
  const std::string absence = context.values->absence(&*store);
  if (!absence.empty() && context.values->here()) {
    context.out.note(context.values->gone(absence) + ": these are the last values");
  }
  if (names.size() == 1 && !schema::is_glob(names.front()) && context.values->here()) {
    if (const auto pools = view_pools(context.node, *store, names.front()); !pools.empty()) {
      return show_pools(context, pools);
    }
  }
  std::vector<Item> items;
  if (const int code = select_items(context, *store, names, items); code != kOk) {
    return code;
  }
  note_old(context, items);
  Table table({{"NAME", "name"}, {"VALUE", "value", Align::Right, 0, kAlignedValue}, {"UNIT", "unit"}});
  for (const Item& item : items) {
    const auto bytes = operate::read(*store, item);
    if (!bytes) {
      context.out.error(bytes.error().text);
      return kFailed;
    }
    const std::string text = schema::format_value(item.place.type, *bytes);
    // The usual `x=$(indurop get NAME)`: one name, prints only its value.
    if (context.format == Format::Table && items.size() == 1) {
      context.out.line(item.place.unit.empty() || !context.out.terminal() ? text : text + " " + item.place.unit);
      return kOk;
    }
    table.add({Cell(item.name), Cell(text, raw_value(item.place.type, *bytes)), Cell(item.place.unit)});
  }
  print_table(context, table, {{"node", context.values->title()}, {"running", absence.empty()}}, "values");
  return kOk;
}

Action declare_get(base::Options& app, Context& context) {
  const auto names = add_items_to_show(app, context);
  return [names](Context& c) { return get(c, *names); };
}

}  // namespace

const Verb kGetVerb{
    "get", "Variables", "Print the value of variables or parts of them",
    "Leading namespaces may be omitted if the rest is unique; '.' and '::' both separate them. For a single name,\n"
    "only the value is printed, so that x=$(indurop get tick) works. For a pool it shows chunks, drops and users.\n"
    "Examples:\n"
    "  indurop get tick\n"
    "  indurop get 'joints[1].y' 'joints[2]'\n"
    "  indurop get 'knu::Robot::*' -o json\n",
    &declare_get};

}  // namespace indurop::tools
