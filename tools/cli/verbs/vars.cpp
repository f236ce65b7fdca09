// SPDX-License-Identifier: Apache-2.0
// indurop vars: lists a node's variables, their values, and which modules write and read them.
#include <fmt/format.h>

#include <algorithm>

#include "tools/cli/plant/pool_tables.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/known_uses.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/text/units.h"
#include "tools/client/values/variables.h"
#include "tools/console/table_text.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kListedValueWidth = 24;
constexpr std::size_t kLongestValue = 40;

struct VarsOptions {
  std::vector<std::string> globs;
  std::string type;
  bool names = false;
};

std::string shortened(const std::string& text) {
  return text.size() <= kLongestValue ? text : fmt::format("{:.{}}...", text, kLongestValue - 3);
}

std::string properties_of(const schema::Variable& variable) {
  std::string text = variable.retain ? "retain" : "";
  if (variable.range) {
    text += (text.empty() ? "" : " ") + range_text(variable.range);
  }
  return text;
}

std::vector<Cell> row(const Item& item, const std::vector<std::uint8_t>& bytes, const config::VariableUse& use,
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

// Returns the globs that mean variables: one that matches pools only means them.
std::vector<std::string> without_pools(const vars::Store& store, const std::vector<std::string>& globs) {
  std::vector<std::string> rest;
  for (const std::string& glob : globs) {
    const auto matches = [&glob](const auto& one) { return schema::glob_match(glob, one.name); };
    const schema::Schema& schema = store.schema();
    const bool pools = std::any_of(schema.pools.begin(), schema.pools.end(), matches);
    if (!pools || std::any_of(schema.variables.begin(), schema.variables.end(), matches)) {
      rest.push_back(glob);
    }
  }
  return rest;
}

std::vector<Column> variable_columns() {
  return {{"NAME", "name"},
          {"TYPE", "type"},
          {"VALUE", "value", Align::Right, 0, kListedValueWidth},
          {"UNIT", "unit"},
          {"NOTES", "", Align::Left, 3},
          {"", "retain"},
          {"", "range"},
          {"WRITTEN BY", "writers", Align::Left, 1},
          {"READ BY", "readers", Align::Left, 2},
          {"DESCRIPTION", "description", Align::Left, 4},
          {"", "source"}};
}

void print_all(Context& context, const Table& variables, const Table& pools, bool running) {
  const bool text = context.format == Format::Table;
  if (!text || !variables.empty() || pools.empty()) {
    print_table(context, variables, {{"node", context.values->title()}, {"running", running}, {"pools", pools.json()}},
                "variables");
  }
  if (text && !pools.empty()) {
    context.out.write((variables.empty() ? "" : "\n") + table_text(pools, context.out));
  }
}

int list(Context& context, const VarsOptions& options) {
  const auto store = open_store(context, vars::Mode::ReadOnly);
  if (!store) {
    return report(context.out, store.error());
  }
  int code = kOk;
  std::vector<Item> items;
  const std::vector<std::string> globs =
      options.globs.empty() ? std::vector<std::string>{"*"} : without_pools(*store, options.globs);
  if (options.globs.empty() && store->schema().variables.empty()) {
    context.out.note(fmt::format("{} has no shared variables", context.values->whose()));
  } else if (const int found = globs.empty() ? kOk
                                             : select_items(context, *store, globs, items,
                                                            options.names ? Values::NotNeeded : Values::Needed);
             found != kOk) {
    return found;
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
  const KnownUses uses = context.values->here() ? known_uses(context.node) : KnownUses{};
  Table table(variable_columns());
  for (const Item& item : items) {
    const auto bytes = operate::read(*store, item);
    if (!bytes) {
      context.out.error(bytes.error().text);
      code = kFailed;
      continue;
    }
    const auto use = uses.find(item.place.variable->name);
    table.add(row(item, *bytes, use == uses.end() ? config::VariableUse{} : use->second, !uses.empty()));
  }
  const std::string absence = context.values->absence(&*store);
  if (!absence.empty() && context.values->here()) {
    context.out.note(context.values->gone(absence) + ": these are the last values");
  }
  print_all(context, table, pool_table(store->schema(), options.globs, options.type), absence.empty());
  return code;
}

Action declare_vars(base::Options& app, Context& context) {
  auto options = std::make_shared<VarsOptions>();
  app.add("names", "GLOB", options->globs, "Names or globs: * ? [a-z]; without '::' the last part alone may match")
      .completes(base::Completion::Variable);
  app.add("-t,--type", "TYPE", options->type, "Only variables of this type (glob)");
  app.flag("--names", options->names, "Print only the names");
  add_node_option(app, context);
  add_remote_options(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return list(c, *options); };
}

}  // namespace

const Verb kVarsVerb{
    "vars", "Variables", "List shared variables: type, value, unit, writers and readers",
    "Writers and readers are read from the module files of the node's configuration; they are omitted (null in\n"
    "JSON) if these files cannot be read. Pools are listed below the variables, in JSON as 'pools', not in CSV; their\n"
    "state is shown by get and status.\n"
    "Examples:\n"
    "  indurop vars\n"
    "  indurop vars 'knu::Robot::*' -o json\n"
    "  indurop vars -t double\n",
    &declare_vars};

}  // namespace indurop::tools
