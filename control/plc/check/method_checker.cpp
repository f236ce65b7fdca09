// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/method_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "control/plc/check/designator.h"
#include "control/plc/check/expression_checker.h"
#include "control/plc/model/make.h"
#include "control/plc/model/walk.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using Meaning = Resolved::Meaning;

bool is_this(const Expression& expression) noexcept {
  return expression.resolved &&
         (expression.resolved->meaning == Meaning::This || expression.resolved->meaning == Meaning::Super);
}

// Returns true for the result of a call and parts of it: their types are kept once they are known, because a call is
// checked only once.
bool comes_from_call(const Expression& expression) noexcept {
  const bool part = expression.kind == Expression::Kind::Member || expression.kind == Expression::Kind::Index;
  return expression.kind == Expression::Kind::Call || expression.kind == Expression::Kind::Deref ||
         (part && comes_from_call(expression.operands[0]));
}

// Returns whether instances of the type have methods.
bool has_methods(const Type& type) noexcept {
  return type.pou != nullptr && (type.kind == Type::Kind::Interface || type.kind == Type::Kind::Block);
}

std::vector<std::string> methods_of(const Pou& pou, bool properties) {
  std::vector<std::string> out;
  for (const Pou* at = &pou; at != nullptr; at = at->base) {
    for (const Pou* one : at->methods) {
      if ((one->tree->accessor != ast::Accessor::None) == properties) {
        out.push_back(one->name);
      }
    }
  }
  return out;
}

}  // namespace

// Checks THIS and SUPER, which are the instance itself, with or without ^; null with an error if there is no instance.
const Type* MethodChecker::this_or_super(Expression& expression) {
  const Pou* self = context_.pou != nullptr ? context_.pou->self() : nullptr;
  const bool super = same_name(expression.name, "SUPER");
  if (self == nullptr || (super && self->base == nullptr)) {
    context_.error(expression.at,
                   self == nullptr ? fmt::format("{} is for function blocks and their methods", upper(expression.name))
                                   : fmt::format("{} extends nothing, so there is no SUPER", self->name));
    return nullptr;
  }
  if (self->type == nullptr) {
    context_.error(expression.at, "a PROGRAM is no instance, so it has no THIS");
    return nullptr;
  }
  resolved(expression).meaning = super ? Meaning::Super : Meaning::This;
  return super ? self->base->type : self->type;
}

// Checks THIS^.x, a variable of the instance even if the method declares one of that name. Returns false if it is not a
// variable.
bool MethodChecker::variable_of_this(Expression& expression) {
  const Expression& base = expression.operands[0];
  const Expression& root = base.kind == Expression::Kind::Deref ? base.operands[0] : base;
  if (!is_this(root)) {
    return false;
  }
  const Pou* self = root.resolved->meaning == Meaning::Super ? context_.pou->self()->base : context_.pou->self();
  if (self->find(upper(expression.name)) == nullptr) {
    return false;
  }
  Expression made;
  made.kind = Expression::Kind::Name;
  made.at = expression.at;
  made.name = std::move(expression.name);
  made.of_this = true;
  expression = std::move(made);
  return true;
}

// Returns whether a method can access the variable of its instance.
bool MethodChecker::can_see(Variable& variable, const Place& at) {
  if (variable.owner == context_.pou || variable.owner == nullptr) {
    return true;
  }
  const bool own_type = context_.pou->self() == variable.owner;
  const bool in_method = variable.section == ast::Section::InOut && context_.pou->owner != nullptr;
  if (in_method && context_.codesys() && variable.type != nullptr && !variable.type->open) {
    variable.in_methods = true;
    return true;
  }
  const char* what = in_method ? "VAR_IN_OUT" : nullptr;
  if (variable.section == ast::Section::Temp) {
    what = "VAR_TEMP";
  } else if (variable.declared->edge != ast::Edge::None) {
    what = "an input with an edge";
  }
  if (what != nullptr) {
    context_.error(
        at, fmt::format("'{}' is {} of {}, which only its body sees; {}", variable.name, what, variable.owner->name,
                        context_.pou->owner != nullptr ? "give it to the method as a parameter"
                                                       : "copy it to another variable"));
    return false;
  }
  if (!own_type && variable.declared->access == ast::Access::Private) {
    context_.error(
        at, fmt::format("'{}' is PRIVATE of {}, declare it as PROTECTED there", variable.name, variable.owner->name));
    return false;
  }
  return true;
}

bool MethodChecker::may_call(const Pou& method, const Place& at) {
  const Pou* self = context_.pou != nullptr ? context_.pou->self() : nullptr;
  const bool inside = self == method.owner;
  const bool extends = self != nullptr && is_a(*self, *method.owner);
  const bool fine = method.tree->access <= ast::Access::Internal || inside ||
                    (method.tree->access == ast::Access::Protected && extends);
  if (!fine) {
    context_.error(
        at, fmt::format("{} is {}", method.title(),
                        method.tree->access == ast::Access::Private
                            ? fmt::format("PRIVATE, only {} itself may use it", method.owner->name)
                            : fmt::format("PROTECTED, only {} and what extends it may use it", method.owner->name)));
  }
  return fine;
}

// Returns the type of the instance before the dot, including THIS and SUPER; null if it has no methods. Reports no
// errors.
const Type* MethodChecker::object(Expression& expression) {
  const bool known = expression.type != nullptr && expression.resolved && comes_from_call(expression);
  const ExpressionChecker::Mode mode{true, expressions_.mode().following};
  const Type* type = known ? expression.type  // chained calls are checked only once
                           : expressions_.with(mode, [&] { return expressions_.typed(expression, nullptr); });
  return type != nullptr && has_methods(*type) ? type : nullptr;
}

// Checks pump.Restart; if it is not an action, the instance is unchanged.
bool MethodChecker::is_action(Expression& callee) {
  const Type* type = object(callee.operands[0]);
  const Pou* method =
      type != nullptr && type->kind == Type::Kind::Block ? find_method(*type->pou, callee.name) : nullptr;
  if (method == nullptr || !method->tree->is_action) {
    return false;
  }
  ast::each_expression(callee.operands[0], [](Expression& each) {
    each.type = nullptr;
    each.resolved = nullptr;
  });
  return true;
}

// Checks x.Speed or Speed as a value: a call of its GET. Null without an error if it is not one.
const Pou* MethodChecker::accessor(const Pou& pou, const Expression& expression, ast::Accessor which) {
  const Pou* found = find_method(pou, expression.name, which);
  const ast::Accessor other = which == ast::Accessor::Get ? ast::Accessor::Set : ast::Accessor::Get;
  if (found == nullptr && find_method(pou, expression.name, other) != nullptr) {
    context_.error(expression.at,
                   which == ast::Accessor::Get
                       ? fmt::format("the PROPERTY {} has no GET, so it cannot be read", expression.name)
                       : fmt::format("the PROPERTY {} has no SET, so it cannot be written", expression.name));
  }
  return found;
}

const Type* MethodChecker::read_property(Expression& expression, const Pou& getter) {
  if (!expressions_.mode().reading && (getter.result == nullptr || !getter.result->is_reference())) {
    context_.error(expression.at,
                   fmt::format("{} is a PROPERTY, which only an assignment x := ... of the whole of it sets; "
                               "use a variable between",
                               getter.name));
    return nullptr;
  }
  std::vector<ast::Argument> none;
  const Place at = expression.at;
  Expression callee = std::move(expression);
  callee.resolved = nullptr;
  expression = make::call(at, std::move(callee), std::move(none));
  return method(expression, getter);
}

// Turns x.Speed := 5 into a call of its SET. Returns false for an ordinary assignment.
bool MethodChecker::write_property(ast::Statement& statement) {
  Expression& target = *statement.target;
  const Pou* found = nullptr;
  const std::size_t before = context_.diagnostics.errors();
  if (!context_.program.has_objects || context_.pou == nullptr) {
    return false;
  }
  if (target.kind == Expression::Kind::Name) {
    const Pou* self = context_.pou->self();
    const bool known = self == nullptr || context_.pou->find(upper(target.name)) != nullptr ||
                       (context_.pou->tree->result && same_name(context_.pou->name, target.name));
    found = known ? nullptr : accessor(*self, target, ast::Accessor::Set);
  } else if (target.kind == Expression::Kind::Member) {
    const Type* type = object(target.operands[0]);
    const bool known = type == nullptr || type->pou->find(upper(target.name)) != nullptr;
    found = known ? nullptr : accessor(*type->pou, target, ast::Accessor::Set);
  }
  if (found == nullptr) {
    return context_.diagnostics.errors() != before;
  }
  std::vector<ast::Argument> arguments;
  arguments.push_back(make::argument("", std::move(*statement.value)));
  const Place at = target.at;
  Expression call = make::call(at, std::move(target), std::move(arguments));
  call.operands[0].resolved = nullptr;
  static_cast<void>(method(call, *found));
  statement.kind = ast::Statement::Kind::Call;
  statement.value = std::move(call);
  statement.target.reset();
  return true;
}

// Returns the method that is called; null if there is none. `said`: an error was reported.
const Pou* MethodChecker::method_of(Expression& callee, bool& said) {
  said = false;
  if (!context_.program.has_objects || context_.pou == nullptr) {
    return nullptr;
  }
  if (callee.kind == Expression::Kind::Name) {
    const Pou* self = context_.pou->self();
    const Variable* variable = context_.pou->find(upper(callee.name));
    return self == nullptr || (variable != nullptr && variable->type != nullptr && !variable->type->is_reference() &&
                               variable->type->kind == Type::Kind::Block)
               ? nullptr
               : find_method(*self, callee.name);
  }
  if (callee.kind != Expression::Kind::Member) {
    return nullptr;
  }
  const std::size_t before = context_.diagnostics.errors();
  const Type* type = object(callee.operands[0]);
  if (type == nullptr) {
    said = context_.diagnostics.errors() != before;
    return nullptr;
  }
  const Pou* found = find_method(*type->pou, callee.name);
  if (found == nullptr && type->pou->find(upper(callee.name)) == nullptr) {
    said = true;
    context_.error(callee.at, fmt::format("{} has no method '{}'{}", type->name, callee.name,
                                          did_you_mean(context_, callee.name, methods_of(*type->pou, false))));
  }
  return found;
}

// Checks the call of the method; returns the type of its result, null after an error or if it has none.
const Type* MethodChecker::method(Expression& call, const Pou& pou) {
  Expression& callee = call.operands[0];
  Resolved& out = resolved(call);
  if (!may_call(pou, callee.at)) {
    return nullptr;
  }
  if (callee.kind == Expression::Kind::Member) {
    const Type* type = object(callee.operands[0]);
    const Expression& root = root_of(callee.operands[0]);
    out.by_super = is_this(root) && root.resolved->meaning == Meaning::Super && type->pou == context_.pou->self()->base;
    if (out.by_super && (pou.tree->is_abstract || pou.owner->tree->kind == ast::Pou::Kind::Interface)) {
      context_.error(callee.at, fmt::format("{} is ABSTRACT, there is nothing to call", pou.title()));
      return nullptr;
    }
    expressions_.writes().note_call(callee.operands[0]);
    context_.pou->uses.insert(type->pou);
  }
  resolved(callee).pou = &pou;
  return expressions_.calls().user_function(call, pou);
}

}  // namespace indurop::plc
