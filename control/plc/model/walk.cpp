// SPDX-License-Identifier: Apache-2.0
#include "control/plc/model/walk.h"

#include <algorithm>

namespace indurop::plc::ast {
namespace {

void each_expression(std::optional<Expression>& expression, const Visit& visit) {
  if (expression) {
    ast::each_expression(*expression, visit);
  }
}

}  // namespace

void each_expression(Expression& expression, const Visit& visit) {
  visit(expression);
  for (Expression& one : expression.operands) {
    each_expression(one, visit);
  }
  for (Argument& one : expression.arguments) {
    each_expression(one.value, visit);
  }
}

void each_expression(Statement& statement, const Visit& visit) {
  for (auto* part : {&statement.target, &statement.value, &statement.to, &statement.by}) {
    each_expression(*part, visit);
  }
  for (Branch& branch : statement.branches) {
    each_expression(branch.condition, visit);
    for (CaseLabel& label : branch.labels) {
      each_expression(label.low, visit);
      each_expression(label.high, visit);
    }
    each_expression(branch.body, visit);
  }
  each_expression(statement.body, visit);
}

void each_expression(Body& body, const Visit& visit) {
  for (Statement& one : body) {
    each_expression(one, visit);
  }
}

void each_expression(Initial& initial, const Visit& visit) {
  each_expression(initial.value, visit);
  for (InitialElement& one : initial.elements) {
    each_expression(one.count, visit);
    each_expression(one.value, visit);
  }
}

std::string path_of(const Expression& expression) {
  if (expression.kind == Expression::Kind::Name) {
    return expression.value_enum.empty() ? expression.name : "";
  }
  const std::string before = expression.kind == Expression::Kind::Member ? path_of(expression.operands[0]) : "";
  return before.empty() ? "" : before + "." + expression.name;
}

std::size_t depth_of(const Expression& expression) {
  std::size_t deepest = 0;
  for (const Expression& one : expression.operands) {
    deepest = std::max(deepest, depth_of(one));
  }
  for (const Argument& one : expression.arguments) {
    deepest = one.value ? std::max(deepest, depth_of(*one.value)) : deepest;
  }
  return deepest + 1;
}

}  // namespace indurop::plc::ast
