// SPDX-License-Identifier: Apache-2.0
#include "plc/lower/flow.h"

#include <memory>
#include <utility>

#include "plc/model/make.h"

namespace indurop::plc::lower {
namespace {

using Kind = FlowPoint::Kind;

const std::string kFlow = "_flow";
constexpr const char* kEnd = "_flow_end";

ast::Expression number(const Place& at, std::uint64_t value) {
  ast::Expression literal;
  literal.at = at;
  literal.value = value;
  return literal;
}

// _flow[43]
ast::Expression point_of(const Place& at, const std::string& variable, std::size_t number_of_point) {
  ast::Expression made;
  made.kind = ast::Expression::Kind::Index;
  made.at = at;
  made.operands.push_back(make::name(at, variable));
  made.operands.push_back(number(at, number_of_point));
  return made;
}

// Through the end of the body, where the flow is written.
bool leave_through_end(ast::Body& body, const Place& at) {
  bool found = false;
  for (ast::Statement& statement : body) {
    if (statement.kind == ast::Statement::Kind::Return) {
      statement.kind = ast::Statement::Kind::Jump;
      statement.label = kEnd;
      found = true;
    }
  }
  if (found) {
    body.push_back(make::label(at, kEnd));
  }
  return found;
}

}  // namespace

std::string flow_variable(const std::string& action) {
  return kFlow + (action.empty() ? "" : "_" + action);
}

bool is_flow(std::string_view variable) {
  return variable == kFlow || variable.starts_with(std::string(kFlow) + "_");
}

void add_flow(LoweredNetworks& lowered, const std::string& variable, const Place& at, bool declare) {
  leave_through_end(lowered.body, at);
  std::size_t points = 0;
  for (FlowPoint& point : lowered.flow) {
    if (point.kind != Kind::Value) {
      const Place place = point.value.at;
      lowered.body.push_back(make::assign(point_of(place, variable, points++), std::move(point.value)));
    }
  }
  if (points > 0 && declare) {
    ast::TypeSpec flags;
    flags.kind = ast::TypeSpec::Kind::Array;
    flags.at = at;
    flags.dimensions.push_back({number(at, 0), number(at, points - 1)});
    flags.element = std::make_shared<ast::TypeSpec>(make::type(at, Elementary::Bool));
    lowered.variables.push_back(make::variable(ast::Section::Local, variable, std::move(flags)));
  }
}

}  // namespace indurop::plc::lower
