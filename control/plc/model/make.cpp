// SPDX-License-Identifier: Apache-2.0
#include "control/plc/model/make.h"

#include <algorithm>

namespace indurop::plc::make {
namespace {

using ast::Expression;
using ast::Statement;

Expression expression(Expression::Kind kind, const Place& at) {
  Expression made;
  made.kind = kind;
  made.at = at;
  return made;
}

Statement statement(Statement::Kind kind, const Place& at) {
  Statement made;
  made.kind = kind;
  made.at = at;
  return made;
}

Expression joined(std::vector<Expression> values, Expression (*join)(Expression left, Expression right)) {
  constexpr std::size_t kDeepest = 64;
  while (values.size() > 1) {
    std::vector<Expression> out;
    for (std::size_t i = 0; i < values.size(); i += kDeepest) {
      Expression one = std::move(values[i]);
      for (std::size_t k = i + 1; k < std::min(values.size(), i + kDeepest); ++k) {
        one = join(std::move(one), std::move(values[k]));
      }
      out.push_back(std::move(one));
    }
    values = std::move(out);
  }
  return std::move(values.front());
}

}  // namespace

Expression wrapped(Expression::Kind kind, Expression inner) {
  Expression made = expression(kind, inner.at);
  made.operands.push_back(std::move(inner));
  return made;
}

Expression truth(const Place& at, bool value) {
  Expression made = expression(Expression::Kind::Literal, at);
  made.value = value;
  made.value_type = Elementary::Bool;
  return made;
}

Expression name(const Place& at, std::string name) {
  Expression made = expression(Expression::Kind::Name, at);
  made.name = std::move(name);
  return made;
}

Expression member(const Place& at, std::string of, std::string field) {
  Expression made = expression(Expression::Kind::Member, at);
  made.name = std::move(field);
  made.operands.push_back(name(at, std::move(of)));
  return made;
}

Expression negation(Expression of) {
  Expression made = expression(Expression::Kind::Unary, of.at);
  made.op = ast::Operator::Not;
  made.operands.push_back(std::move(of));
  return made;
}

Expression binary(ast::Operator op, Expression left, Expression right) {
  Expression made = expression(Expression::Kind::Binary, left.at);
  made.op = op;
  made.operands.push_back(std::move(left));
  made.operands.push_back(std::move(right));
  return made;
}

Expression call(const Place& at, Expression callee, std::vector<ast::Argument> arguments) {
  Expression made = expression(Expression::Kind::Call, at);
  made.operands.push_back(std::move(callee));
  made.arguments = std::move(arguments);
  return made;
}

ast::Argument argument(std::string name, Expression value) {
  ast::Argument made;
  made.at = value.at;
  made.name = std::move(name);
  made.value = std::move(value);
  return made;
}

bool is_true(const Expression& expression) noexcept {
  const bool* value = std::get_if<bool>(&expression.value);
  return expression.kind == Expression::Kind::Literal && value != nullptr && *value;
}

Expression both(Expression left, Expression right) {
  if (is_true(left)) {
    return right;
  }
  return is_true(right) ? std::move(left) : binary(ast::Operator::And, std::move(left), std::move(right));
}

Expression either(Expression left, Expression right) {
  if (is_true(left)) {
    return left;
  }
  return is_true(right) ? std::move(right) : binary(ast::Operator::Or, std::move(left), std::move(right));
}

Expression all_of(std::vector<Expression> values) {
  return joined(std::move(values), &both);
}

Expression any_of(std::vector<Expression> values) {
  return joined(std::move(values), &either);
}

Statement assign(Expression target, Expression value) {
  Statement made = statement(Statement::Kind::Assign, target.at);
  made.target = std::move(target);
  made.value = std::move(value);
  return made;
}

Statement call_statement(Expression call) {
  Statement made = statement(Statement::Kind::Call, call.at);
  made.value = std::move(call);
  return made;
}

Statement when(Expression condition, ast::Body body) {
  Statement made = statement(Statement::Kind::If, condition.at);
  ast::Branch branch;
  branch.at = condition.at;
  branch.condition = std::move(condition);
  branch.body = std::move(body);
  made.branches.push_back(std::move(branch));
  return made;
}

Statement leave(const Place& at, std::string label, Expression condition) {
  Statement made = statement(label.empty() ? Statement::Kind::Return : Statement::Kind::Jump, at);
  made.label = std::move(label);
  if (!is_true(condition)) {
    made.value = std::move(condition);
  }
  return made;
}

Statement label(const Place& at, std::string name) {
  Statement made = statement(Statement::Kind::Label, at);
  made.label = std::move(name);
  return made;
}

ast::TypeSpec type(const Place& at, Elementary elementary) {
  ast::TypeSpec made;
  made.at = at;
  made.elementary = elementary;
  return made;
}

ast::TypeSpec type(const Place& at, std::string named) {
  ast::TypeSpec made;
  made.kind = ast::TypeSpec::Kind::Named;
  made.at = at;
  made.name = std::move(named);
  return made;
}

ast::TypeSpec inferred_type(const Place& at) {
  ast::TypeSpec made;
  made.kind = ast::TypeSpec::Kind::Inferred;
  made.at = at;
  return made;
}

ast::Variable variable(ast::Section section, std::string name, ast::TypeSpec type) {
  ast::Variable made;
  made.section = section;
  made.made = true;
  made.at = type.at;
  made.name = std::move(name);
  made.type = std::move(type);
  return made;
}

}  // namespace indurop::plc::make
