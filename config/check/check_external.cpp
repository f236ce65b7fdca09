// SPDX-License-Identifier: Apache-2.0
// Checks topics for third-party tools: libraries of their types, and rules for single variables.

#include <algorithm>
#include <map>

#include "config/check/check_parts.h"
#include "core/base/text.h"
#include "core/schema/elf.h"
#include "core/schema/place_index.h"

namespace indurop::config {

std::string type_library_problem(const TypeFiles& named, std::size_t library, const CheckOptions& options) {
  const std::string& written = named.types_as_written[library];
  const auto read = schema::read_module_file(named.types[library]);
  if (!read) {
    return unreadable_file(read.error(), {named.types[library], written, "<types>"}, true);
  }
  std::string problem = read.value().shared_object
                            ? machine_problem(read.value().machine, options)
                            : std::string(
                                  "is a program, not a library of types; name the lib..._types.so that "
                                  "indurop_add_glb(... TYPES) builds");
  return problem.empty() ? problem : base::path_in_quotes(written) + " " + problem;
}

void resolve_rules(std::vector<VariableRule>& rules, const schema::Schema& schema, base::Diagnostics& report) {
  const schema::PlaceIndex index(schema);
  std::map<std::string, int> lines;
  std::erase_if(rules, [&](VariableRule& rule) {
    const auto place = index.find(rule.name, report.full() ? schema::NearestName::Skip : schema::NearestName::Search);
    if (!place) {
      report.error(rule.place, "<variable>: " + place.error().message);
      return true;
    }
    const schema::Variable& variable = *place.value().variable;
    if (schema::canonical(place.value().type) != schema::canonical(variable.type)) {
      report.error(rule.place, base::in_quotes(rule.name) +
                                   " is a part of a variable, which is sent as a whole; write name=\"" + variable.name +
                                   "\"");
      return true;
    }
    const auto [first, is_first] = lines.try_emplace(variable.name, rule.place.line);
    if (!is_first) {
      report.error(rule.place, "a second <variable> for " + base::in_quotes(variable.name) + ", the first is in line " +
                                   std::to_string(first->second) + "; write both in one");
      return true;
    }
    rule.name = variable.name;
    return false;
  });
}

void check_external_rules(const std::vector<VariableRule>& rules, bool shown, const Uses& uses,
                          base::Diagnostics& report) {
  for (const VariableRule& rule : rules) {
    if (rule.external != VariableRule::External::Write) {
      continue;
    }
    if (!shown) {
      report.warning(rule.place, "no tool can set " + base::in_quotes(rule.name) +
                                     " from outside: without <types>, or with <external>off</external>, there are no "
                                     "topics for other tools");
    }
    const auto users = uses.variables().find(rule.name);
    if (users != uses.variables().end() && !users->second.writers.empty()) {
      report.warning(rule.place,
                     base::in_quotes(rule.name) + " may be set from outside, but is also written by " +
                         base::enumerate(uses.names(users->second.writers)) +
                         ", which overwrites the value that was set; use a separate variable for one of them");
    }
  }
}

bool has_array_of_texts(const schema::Type& type) {
  return (type.base == schema::Base::Text && !type.dims.empty()) ||
         std::any_of(type.fields.begin(), type.fields.end(),
                     [](const schema::Field& field) { return has_array_of_texts(field.type); });
}

void check_foreign_types(const TypeFiles& named, const std::vector<VariableRule>& rules, const schema::Schema& schema,
                         base::Diagnostics& report) {
  if (named.types.empty()) {
    return;
  }
  std::vector<std::string> names;
  for (const schema::Variable& variable : schema.variables) {
    const bool off = std::any_of(rules.begin(), rules.end(), [&](const VariableRule& rule) {
      return rule.name == variable.name && rule.external == VariableRule::External::Off;
    });
    if (!off && has_array_of_texts(variable.type)) {
      names.push_back(variable.name);
    }
  }
  if (!names.empty()) {
    report.note(named.type_places.front(),
                "arrays of texts are misread by programs made with fastddsgen 2.3 (Debian 12), with all that follows "
                "them: " +
                    base::enumerate(names) + "; for such programs use an array of structs with one text each");
  }
}

std::set<std::string> check_external(CheckContext& context, const Uses& uses) {
  ExternalPlane& plane = context.config.external;
  for (std::size_t i = 0; i < plane.types.size(); ++i) {
    if (const std::string problem = type_library_problem(plane, i, context.options); !problem.empty()) {
      context.report.error(plane.type_places[i], problem);
    }
  }
  resolve_rules(plane.variables, context.result.schema, context.report);
  check_external_rules(plane.variables, plane.domain && !plane.types.empty(), uses, context.report);
  if (plane.domain) {
    check_foreign_types(plane, plane.variables, context.result.schema, context.report);
  }
  std::set<std::string> settable;
  for (const VariableRule& rule : plane.variables) {
    if (rule.external == VariableRule::External::Write) {
      settable.insert(rule.name);
    }
  }
  return settable;
}

}  // namespace indurop::config
