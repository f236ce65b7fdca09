// SPDX-License-Identifier: Apache-2.0
// indurop typeof: the type of a variable and of its parts.
#include <fmt/format.h>

#include "tools/cli/values/items_to_show.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/values/variables.h"

namespace indurop::tools {
namespace {

std::string values_text(const schema::Type& type) {
  std::string text;
  for (const schema::Enumerator& one : type.enumerators) {
    text += (text.empty() ? "" : ", ") + one.name;
  }
  return text;
}

JsonValue values_json(const schema::Type& type) {
  JsonValue values = JsonValue::object();
  for (const schema::Enumerator& one : type.enumerators) {
    values[one.name] = one.value;
  }
  return type.enumerators.empty() ? JsonValue() : values;
}

// Adds a line for the type itself and one for each part below it; the elements of an array get only one.
void add_parts(Table& table, const std::string& name, const schema::Place& place, const std::string& description) {
  const schema::Type& type = place.type;
  table.add({Cell(name),
             Cell(schema::display_name(type)),
             Cell(place.unit),
             {range_text(place.range), place.range ? JsonValue{place.range->min, place.range->max} : JsonValue()},
             {std::to_string(place.offset), place.offset},
             {std::to_string(type.size()), type.size()},
             {values_text(type), values_json(type)},
             Cell(description)});
  for (const schema::Field& field : type.fields) {
    const std::string indices = type.dims.empty() ? "" : "[]";
    add_parts(table, name + indices + "." + field.name,
              {place.variable, field.type, place.offset + field.offset, field.unit, field.range}, field.description);
  }
}

int type_of(Context& context, const std::vector<std::string>& names) {
  const auto store = open_store(context, vars::Mode::ReadOnly, names);
  if (!store) {
    return report(context.out, store.error());
  }
  std::vector<Item> items;
  if (const int code = select_items(context, *store, names, items, Values::NotNeeded); code != kOk) {
    return code;
  }
  Table table({{"NAME", "name"},
               {"TYPE", "type"},
               {"UNIT", "unit"},
               {"RANGE", "range"},
               {"OFFSET", "offset", Align::Right, 2},
               {"SIZE", "size", Align::Right, 1},
               {"VALUES", "values"},
               {"DESCRIPTION", "description", Align::Left, 3}});
  for (const Item& item : items) {
    const bool whole = item.place.offset == 0 && item.name == item.place.variable->name;
    add_parts(table, item.name, item.place, whole ? item.place.variable->description : "");
  }
  print_table(context, table, {{"node", context.values->title()}}, "parts");
  return kOk;
}

Action declare_typeof(base::Options& app, Context& context) {
  const auto names = add_items_to_show(app, context);
  return [names](Context& c) { return type_of(c, *names); };
}

}  // namespace

const Verb kTypeofVerb{
    "typeof", "Variables", "Show what variables are made of",
    "Shows fields with type, unit, range and offset; the fields of an array of structs are shown once.\n"
    "Examples:\n"
    "  indurop typeof joints\n"
    "  indurop typeof 'cell::*' --remote\n",
    &declare_typeof};

}  // namespace indurop::tools
