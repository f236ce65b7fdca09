// SPDX-License-Identifier: Apache-2.0
// indurop get: values of variables or parts of them, once.
#include <fmt/format.h>

#include "tools/node_choice.h"
#include "tools/variables.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kAlignedValue = 24;

int get(Context& context, const std::vector<std::string>& names) {
  int code = kOk;
  const auto store = open_store(context, vars::Mode::ReadOnly, code);
  if (!store) {
    return code;
  }
  const std::string absence = values_absence(context, *store);
  if (!absence.empty() && context.far_values == nullptr) {
    context.out.note(fmt::format("node '{}' is {}: these are the last values", context.node, absence));
  }
  std::vector<Item> items;
  if (!select_items(context, *store, names, items)) {
    return kFailed;
  }
  Table table({{"NAME", "name"}, {"VALUE", "value", Align::Right, 0, kAlignedValue}, {"UNIT", "unit"}});
  for (const Item& item : items) {
    std::string problem;
    const auto bytes = read_item(*store, item, problem);
    if (!problem.empty()) {
      context.out.error(problem);
      return kFailed;
    }
    const std::string text = schema::format_value(item.place.type, bytes);
    // The usual `x=$(indurop get NAME)`: one name, nothing but its value.
    if (context.format == Format::Table && items.size() == 1) {
      context.out.line(item.place.unit.empty() || !context.out.terminal() ? text : text + " " + item.place.unit);
      return kOk;
    }
    table.add({Cell(item.name), Cell(text, raw_value(item.place.type, bytes)), Cell(item.place.unit)});
  }
  print_table(context, table, {{"node", name_of_source(context)}, {"running", absence.empty()}}, "values");
  return kOk;
}

Action declare(CLI::App& app, Context& context) {
  auto names = std::make_shared<std::vector<std::string>>();
  app.add_option("names", *names, "Variables, parts of them (joints[1].y) or globs ('knu::*')")
      ->required()
      ->type_name("NAME");
  add_node_option(app, context);
  add_far_options(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [names](Context& c) { return get(c, *names); };
}

}  // namespace

const Verb kGetVerb{"get", "Variables", "Print the value of variables or parts of them",
                    "Leading namespaces may be left out if the rest is unique; '.' and '::' both separate them.\n"
                    "One name prints nothing but its value, so that x=$(indurop get tick) works.\n"
                    "Examples:\n"
                    "  indurop get tick\n"
                    "  indurop get 'joints[1].y' 'joints[2]'\n"
                    "  indurop get 'knu::Robot::*' -o json\n",
                    &declare};

}  // namespace indurop::tools
