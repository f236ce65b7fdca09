// SPDX-License-Identifier: Apache-2.0
// indurop vars: which variables a node has, their values, and which modules write and read them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "deploy/uses.h"
#include "tools/config_file.h"
#include "tools/node_choice.h"
#include "tools/units.h"
#include "tools/variables.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kAlignedValue = 24;
constexpr std::size_t kLongestValue = 40;

struct Options {
  std::vector<std::string> globs;
  std::string type;
  bool names = false;
};

using Uses = std::map<std::string, deploy::VariableUse>;

// Modules of all boards, "control@sensor".
std::vector<deploy::VariableUse> uses_in(const CheckedPlant& checked) {
  const auto boards = deploy::views_of(checked.plant, checked.check);
  const deploy::Uses uses(boards);
  std::vector<deploy::VariableUse> all;
  for (const auto& [name, users] : uses.variables()) {
    all.push_back({name, uses.names(users.readers), uses.names(users.writers)});
  }
  return all;
}

// From the module files of the configuration the node runs: no question is put to the node. Empty if it cannot be had.
Uses known_uses(const std::string& node) {
  Uses uses;
  const auto run = RunView::open(node);
  if (!run.ok()) {
    return uses;
  }
  const std::string file = fixed_text(run.value().block().config_file);
  const deploy::CheckOptions options{.files = true, .adjust = true};
  for (const deploy::VariableUse& use :
       deploy::is_plant_file(file) ? uses_in(load_plant(file, options)) : load_config(file, options).check.uses) {
    uses.emplace(use.name, use);
  }
  return uses;
}

std::string shortened(const std::string& text) {
  return text.size() <= kLongestValue ? text : text.substr(0, kLongestValue - 3) + "...";
}

Cell name_list(const std::vector<std::string>& names) {
  return {names.empty() ? "-" : fmt::format("{}", fmt::join(names, ", ")), JsonValue(names)};
}

std::string properties_of(const schema::Variable& variable) {
  std::string text = variable.retain ? "retain" : "";
  if (variable.range) {
    text += (text.empty() ? "" : " ") + range_text(variable.range);
  }
  return text;
}

std::vector<Cell> row(const Item& item, const std::vector<std::uint8_t>& bytes, const deploy::VariableUse& use,
                      bool uses_known) {
  const schema::Variable& variable = *item.place.variable;
  const auto modules = [uses_known](const std::vector<std::string>& names) {
    return uses_known ? name_list(names) : Cell("", JsonValue());
  };
  return {Cell(item.name),
          Cell(schema::display_name(variable.type)),
          {shortened(schema::format_value(variable.type, bytes)), raw_value(variable.type, bytes)},
          Cell(variable.unit),
          {properties_of(variable), JsonValue()},
          {"", variable.retain},
          {"", variable.range ? JsonValue{variable.range->min, variable.range->max} : JsonValue()},
          modules(use.writers),
          modules(use.readers),
          Cell(variable.description),
          Cell(variable.source)};
}

int list(Context& context, const Options& options) {
  int code = kOk;
  const auto store = open_store(context, vars::Mode::ReadOnly, code);
  if (!store) {
    return code;
  }
  std::vector<Item> items;
  const std::vector<std::string> everything{"*"};
  if (options.globs.empty() && store->schema().variables.empty()) {
    context.out.note(fmt::format("{} has no shared variables", values_of(context)));
  } else if (!select_items(context, *store, options.globs.empty() ? everything : options.globs, items,
                           options.names ? Values::NotNeeded : Values::Needed)) {
    return kFailed;
  }
  std::erase_if(items, [&](const Item& item) {
    return !options.type.empty() && !schema::glob_match(options.type, schema::display_name(item.place.type));
  });
  std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.name < b.name; });
  if (options.names) {
    for (const Item& item : items) {
      context.out.line(item.name);
    }
    return kOk;
  }
  const Uses uses = context.far_values != nullptr ? Uses{} : known_uses(context.node);
  Table table({{"NAME", "name"},
               {"TYPE", "type"},
               {"VALUE", "value", Align::Right, 0, kAlignedValue},
               {"UNIT", "unit"},
               {"NOTES", "", Align::Left, 3},
               {"", "retain"},
               {"", "range"},
               {"WRITTEN BY", "writers", Align::Left, 1},
               {"READ BY", "readers", Align::Left, 2},
               {"DESCRIPTION", "description", Align::Left, 4},
               {"", "source"}});
  for (const Item& item : items) {
    std::string problem;
    const auto bytes = read_item(*store, item, problem);
    if (!problem.empty()) {
      context.out.error(problem);
      code = kFailed;
      continue;
    }
    const auto use = uses.find(item.place.variable->name);
    table.add(row(item, bytes, use == uses.end() ? deploy::VariableUse{} : use->second, !uses.empty()));
  }
  const std::string absence = values_absence(context, *store);
  if (!absence.empty() && context.far_values == nullptr) {
    context.out.note(fmt::format("node '{}' is {}: these are the last values", context.node, absence));
  }
  print_table(context, table, {{"node", name_of_source(context)}, {"running", absence.empty()}}, "variables");
  return code;
}

Action declare(CLI::App& app, Context& context) {
  auto options = std::make_shared<Options>();
  app.add_option("names", options->globs, "Names or globs: * ? [a-z]; without '::' the last part alone may match")
      ->type_name("GLOB");
  app.add_option("-t,--type", options->type, "Only variables of this type (glob)")->type_name("TYPE");
  app.add_flag("--names", options->names, "Print nothing but the names");
  add_node_option(app, context);
  add_far_options(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return list(c, *options); };
}

}  // namespace

const Verb kVarsVerb{
    "vars", "Variables", "List shared variables: type, value, unit, who writes and reads them",
    "Writers and readers come from the module files of the node's configuration and are left out if these cannot be\n"
    "read (null in JSON).\n"
    "Examples:\n"
    "  indurop vars\n"
    "  indurop vars 'knu::Robot::*' -o json\n"
    "  indurop vars -t double\n",
    &declare};

}  // namespace indurop::tools
