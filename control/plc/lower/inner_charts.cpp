// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/inner_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "control/plc/lower/flow.h"
#include "control/plc/model/elementary.h"
#include "control/plc/model/walk.h"

namespace indurop::plc::lower {
namespace {

using Names = std::map<std::string, std::string>;  // names in capitals, and their replacements

void rename(Lowered& code, const Names& names) {
  for (ast::Variable& one : code.variables) {
    if (const auto to = names.find(upper(one.name)); to != names.end()) {
      one.name = to->second;
    }
  }
  ast::each_expression(code.body, [&](ast::Expression& one) {
    if (const auto to = names.find(upper(one.name)); one.kind == ast::Expression::Kind::Name && to != names.end()) {
      one.name = to->second;
    }
  });
}

// Returns true for variables made by the translation.
bool is_hidden(const ast::Variable& variable) {
  return variable.name.starts_with('_');
}

}  // namespace

// Returns whether the name is used by a variable, or by a step of the POU's own chart.
bool InnerCharts::is_taken(const std::string& name) const {
  const auto& elements = code_->body.diagram.elements;
  return std::any_of(pou_->variables.begin(), pou_->variables.end(),
                     [&](const ast::Variable& one) { return same_name(one.name, name); }) ||
         std::any_of(elements.begin(), elements.end(), [&](const network::Element& one) {
           return one.kind == network::Element::Kind::Step && same_name(one.text, name);
         });
}

Lowered InnerCharts::use(const network::Body& body, const std::function<Lowered()>& lower) {
  if (!known_.contains(&body)) {
    Lowered code = lower();
    const std::string prefix = fmt::format("_s{}_", known_.size() + 1);
    Names names;
    for (const ast::Variable& one : code.variables) {
      if (!is_flow(one.name) && (is_hidden(one) || is_taken(one.name))) {
        names[upper(one.name)] = prefix + one.name.substr(is_hidden(one) ? 1 : 0);
      }
    }
    rename(code, names);
    Lowered& known = known_[&body];
    for (ast::Variable& one : code.variables) {
      (one.section == ast::Section::Temp ? known.variables : pou_->variables).push_back(std::move(one));
    }
    known.body = std::move(code.body);
    return known;  // with names that no other place has
  }
  Lowered out = known_[&body];
  Names names;
  const std::string prefix = fmt::format("_u{}_", ++uses_);
  for (const ast::Variable& one : out.variables) {
    names[upper(one.name)] = prefix + one.name.substr(1);
  }
  rename(out, names);
  return out;
}

}  // namespace indurop::plc::lower
