// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/flow.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "control/plc/model/make.h"

namespace indurop::plc::lower {
namespace {

using PointKind = FlowPoint::Kind;

const std::string kFlow = "_flow";
constexpr const char* kEnd = "_flow_end";

ast::Expression number(const Place& at, std::uint64_t value) {
  ast::Expression literal;
  literal.at = at;
  literal.value = value;
  return literal;
}

// Returns _flow[43].
ast::Expression point_of(const Place& at, const std::string& variable, std::size_t number_of_point) {
  ast::Expression made;
  made.kind = ast::Expression::Kind::Index;
  made.at = at;
  made.operands.push_back(make::name(at, variable));
  made.operands.push_back(number(at, number_of_point));
  return made;
}

// Makes the body leave through its end, where the flow is written.
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

bool has_jumps(const ast::Body& body) {
  return std::any_of(body.begin(), body.end(),
                     [](const ast::Statement& one) { return one.kind == ast::Statement::Kind::Jump; });
}

}  // namespace

std::string flow_variable(const std::string& action) {
  return kFlow + (action.empty() ? "" : "_" + action);
}

bool is_flow(std::string_view variable) {
  return variable == kFlow || variable.starts_with(std::string(kFlow) + "_");
}

std::size_t number_points(std::vector<FlowPoint>& flow) {
  std::map<std::pair<std::size_t, std::string>, std::size_t> known;  // by network
  std::size_t next = 0;
  for (FlowPoint& point : flow) {
    if (point.kind == PointKind::Value) {
      continue;
    }
    const bool name = point.value.kind == ast::Expression::Kind::Name;
    const auto [place, made] =
        name ? known.try_emplace({point.behind, upper(point.value.name)}, next) : std::pair(known.end(), true);
    point.number = made ? next : place->second;
    next += made ? 1 : 0;
  }
  return next;
}

void add_flow(LoweredNetworks& lowered, const std::string& variable, const Place& at, bool declare) {
  // Networks that are jumped over have no power, so with jumps it is written at the end only.
  const bool at_end = leave_through_end(lowered.body, at) || has_jumps(lowered.body);
  number_points(lowered.flow);
  std::size_t points = 0;
  std::size_t taken = 0;
  ast::Body body;
  const auto take_until = [&](std::size_t end) {
    for (; taken < end; ++taken) {
      body.push_back(std::move(lowered.body[taken]));
    }
  };
  for (FlowPoint& point : lowered.flow) {
    if (point.kind == PointKind::Value || point.number < points) {
      continue;
    }
    take_until(at_end ? lowered.body.size() : point.behind);
    const Place place = point.value.at;
    body.push_back(make::assign(point_of(place, variable, points++), std::move(point.value)));
  }
  take_until(lowered.body.size());
  lowered.body = std::move(body);
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
