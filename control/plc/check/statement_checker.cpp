// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/statement_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "control/plc/check/lifetime.h"
#include "control/plc/model/make.h"

namespace indurop::plc {

using ast::Statement;

namespace {

// Checks x.Speed; as editors allow: only the GET of the PROPERTY runs. Returns false for an ordinary call.
bool read_alone(Context& context, ExpressionChecker& expressions, Statement& one) {
  ast::Expression& call = *one.value;
  const bool brackets = call.arguments.size() != 1 || call.arguments[0].value || !call.arguments[0].name.empty();
  if (brackets) {
    return false;
  }
  ast::Expression read = std::move(call.operands[0]);
  const Type* type = expressions.value(read);
  const bool nothing = type != nullptr && read.kind != ast::Expression::Kind::Call;
  const std::string text = "a value alone does nothing: assign it with ':=', call it with '()', or remove it";
  if (nothing && context.codesys()) {
    context.warning(read.at, text);
    one.kind = Statement::Kind::Empty;
  } else if (nothing) {
    context.error(read.at, text);
  }
  call = std::move(read);
  return true;
}

// Returns whether a statement in the body of a loop leaves it.
bool leaves(const ast::Body& body, bool innermost) {
  return std::any_of(body.begin(), body.end(), [&](const Statement& one) {
    using Kind = Statement::Kind;
    const bool loop = one.kind == Kind::For || one.kind == Kind::While || one.kind == Kind::Repeat;
    return one.kind == Kind::Return || one.kind == Kind::Jump || (one.kind == Kind::Exit && innermost) ||
           leaves(one.body, innermost && !loop) ||
           std::any_of(one.branches.begin(), one.branches.end(),
                       [&](const ast::Branch& branch) { return leaves(branch.body, innermost); });
  });
}

}  // namespace

void StatementChecker::body(ast::Body& body) {
  collect_labels(body, true);
  list(body);
}

void StatementChecker::collect_labels(ast::Body& body, bool outermost) {
  for (Statement& one : body) {
    if (one.kind == Statement::Kind::Label) {
      if (!outermost) {
        context_.error(one.at, "a label cannot stand inside of another statement, move it out");
      } else if (!context_.pou->labels.insert(upper(one.label)).second) {
        context_.error(one.at, fmt::format("the label '{}' is there twice, rename one of them", one.label));
      }
    }
    for (ast::Branch& branch : one.branches) {
      collect_labels(branch.body, false);
    }
    collect_labels(one.body, false);
  }
}

void StatementChecker::list(ast::Body& body) {
  bool left = false;
  for (Statement& one : body) {
    if (left && one.kind != Statement::Kind::Label && one.kind != Statement::Kind::Empty) {
      context_.warning(one.at, "this statement is never reached");
    }
    statement(one);
    const bool leaves = one.kind == Statement::Kind::Exit || one.kind == Statement::Kind::Continue ||
                        one.kind == Statement::Kind::Return || one.kind == Statement::Kind::Jump;
    left = leaves && !one.value;
  }
}

void StatementChecker::statement(Statement& one) {
  switch (one.kind) {
    case Statement::Kind::Empty:
    case Statement::Kind::Label:
      break;
    case Statement::Kind::Assign:
      assign(one);
      break;
    case Statement::Kind::Call:
      if (!read_alone(context_, expressions_, one) && !action_with_values(one)) {
        expressions_.call_statement(*one.value);
      }
      break;
    case Statement::Kind::If:
      if_statement(one);
      break;
    case Statement::Kind::Case:
      case_statement(one);
      break;
    case Statement::Kind::For:
      for_statement(one);
      break;
    case Statement::Kind::While:
    case Statement::Kind::Repeat:
      condition(*one.value);
      warn_about_endless(one);
      ++loops_;
      list(one.body);
      --loops_;
      break;
    case Statement::Kind::Exit:
    case Statement::Kind::Continue:
      if (loops_ == 0) {
        context_.error(one.at, fmt::format("{} stands outside of a loop, remove it",
                                           one.kind == Statement::Kind::Exit ? "EXIT" : "CONTINUE"));
      }
      break;
    case Statement::Kind::Jump:
      if (!context_.pou->labels.contains(upper(one.label))) {
        context_.error(one.at, fmt::format("there is no label '{}' in this body", one.label));
      }
      [[fallthrough]];
    case Statement::Kind::Return:
      if (one.value) {
        condition(*one.value);
      }
      break;
  }
}

// Checks pump.Restart(speed := 5, running => r): the action Restart has no parameters, they are those of pump.
bool StatementChecker::action_with_values(Statement& one) {
  ast::Expression& callee = one.value->operands[0];
  if (callee.kind != ast::Expression::Kind::Member || one.value->arguments.empty() || !context_.program.has_objects) {
    return false;
  }
  if (!expressions_.methods().is_action(callee)) {
    return false;
  }
  ast::Body before;
  ast::Body after;
  for (ast::Argument& each : std::exchange(one.value->arguments, {})) {
    if (each.name.empty() || each.negated) {
      context_.error(each.at, fmt::format("values of an action are those of its instance: {} := ...",
                                          each.name.empty() ? "input" : each.name));
    } else if (each.value) {
      ast::Expression pin = make::member(each.at, "", each.name);
      pin.operands[0] = callee.operands[0];
      (each.output ? after : before)
          .push_back(each.output ? make::assign(std::move(*each.value), std::move(pin))
                                 : make::assign(std::move(pin), std::move(*each.value)));
    }
  }
  before.push_back(make::call_statement(std::move(*one.value)));
  std::move(after.begin(), after.end(), std::back_inserter(before));
  one = make::when(make::truth(one.at, true), std::move(before));
  statement(one);
  return true;
}

// Warns of a WHILE TRUE that nothing leaves: the scan would not end.
void StatementChecker::warn_about_endless(const Statement& one) {
  const Constant* known = constant_of(*one.value);
  const bool goes_on = one.kind == Statement::Kind::While;
  if (known != nullptr && *known == Constant(goes_on) && !leaves(one.body, true)) {
    context_.warning(one.at, "this loop never ends, and so does the scan; leave it with EXIT");
  }
}

void StatementChecker::condition(ast::Expression& expression) {
  const Type* type = expressions_.value(expression, context_.elementary(Elementary::Bool));
  if (type != nullptr && !type->is(Elementary::Bool) && !adapt(expression, *context_.elementary(Elementary::Bool))) {
    context_.error(expression.at,
                   fmt::format("a condition is a BOOL, not {}, compare it with something", with_article(*type)));
  }
}

// Gives a temporary of a translated network the type of its first value.
bool StatementChecker::infer(Statement& one) {
  Variable* variable =
      one.target->kind == ast::Expression::Kind::Name ? context_.pou->find(upper(one.target->name)) : nullptr;
  if (variable == nullptr || variable->type != nullptr ||
      variable->declared->type.kind != ast::TypeSpec::Kind::Inferred) {
    return true;
  }
  const Type* type = one.value->kind == ast::Expression::Kind::Call ? expressions_.top_call(*one.value, nullptr)
                                                                    : expressions_.value(*one.value);
  variable->type = type != nullptr && type->range ? context_.elementary(type->elementary) : type;
  return type != nullptr;
}

// Checks r REF= x; for the reference itself, not its target.
void StatementChecker::bind(Statement& one) {
  const Type* to = expressions_.pointers().reference_itself(*one.target);
  if (to != nullptr && !to->is_reference()) {
    context_.error(one.at, fmt::format("REF= sets a REFERENCE TO, not {}", with_article(*to)));
  } else if (to != nullptr) {
    if (expressions_.assigned(*one.value, *to)) {
      check_lifetime(context_, one);
    }
    const bool result = one.target->resolved->meaning == Resolved::Meaning::FunctionResult;
    context_.pou->result_assigned = context_.pou->result_assigned || result;
  }
}

// Checks a ?= b: NULL unless the target of b is of the type of a.
void StatementChecker::attempt(Statement& one) {
  const auto leads = [](const Type& type) {
    const Type* to = type.kind == Type::Kind::Interface ? &type
                     : type.kind == Type::Kind::Pointer ? type.element
                                                        : nullptr;
    return to != nullptr && to->pou != nullptr &&
           (to->kind == Type::Kind::Interface ? &type == to : to->pou->is_object);
  };
  const Type* to = expressions_.writes().target(*one.target);
  const Type* from = expressions_.value(*one.value);
  if (to != nullptr && from != nullptr && !(leads(*to) && leads(*from))) {
    context_.error(one.at,
                   fmt::format("?= is for interfaces and references to function blocks with methods, not for {} "
                               "and {}",
                               with_article(*to), with_article(*from)));
  }
}

void StatementChecker::assign(Statement& one) {
  if (one.attempts) {
    attempt(one);
    return;
  }
  if (one.binds) {
    bind(one);
    return;
  }
  if (!infer(one)) {
    return;
  }
  if (expressions_.methods().write_property(one)) {
    return;
  }
  const Type* to = expressions_.writes().target(*one.target, true);
  if (to == nullptr) {
    expressions_.value_or_instance(*one.value);
    return;
  }
  if (to->kind == Type::Kind::Block) {
    copy_instance(one, *to);
    return;
  }
  if (counts_as_truth(*one.target, *to)) {  // a coil writes 1 or 0
    std::vector<ast::Argument> arguments;
    arguments.push_back(make::argument("", std::move(*one.value)));
    one.value = make::call(one.at, make::name(one.at, fmt::format("BOOL_TO_{}", name_of(to->elementary))),
                           std::move(arguments));
  }
  if (expressions_.assigned(*one.value, *to)) {
    check_lifetime(context_, one);
  }
}

// Checks fb := other; which copies all its variables, as CODESYS does.
void StatementChecker::copy_instance(Statement& one, const Type& to) {
  const Type* from = expressions_.value_or_instance(*one.value, &to);
  if (from == nullptr) {
    return;
  }
  if (!context_.codesys()) {
    context_.error(one.at,
                   fmt::format("{} contains or is a function block, which is not assigned as a whole; assign its "
                               "variables, or say --dialect codesys",
                               with_article(to)));
  } else if (from != &to) {
    context_.error(
        one.at, fmt::format("{} is not {}, whose variables it would take over", with_article(*from), with_article(to)));
  }
}

void StatementChecker::if_statement(Statement& one) {
  for (ast::Branch& branch : one.branches) {
    if (branch.condition) {
      condition(*branch.condition);
    }
    list(branch.body);
  }
}

void StatementChecker::case_statement(Statement& one) {
  const Type* type = expressions_.value(*one.value);
  const bool whole = type != nullptr && (type->kind == Type::Kind::Enum ||
                                         (type->kind == Type::Kind::Elementary && !type->is(Elementary::Bool) &&
                                          (is_int(type->elementary) || is_bit(type->elementary))));
  if (type != nullptr && !whole) {
    context_.error(one.value->at,
                   fmt::format("CASE decides by a whole number or an enumeration, not by {}", with_article(*type)));
  }
  if (whole && one.value->resolved->untyped) {
    adapt(*one.value, *type);
  }
  std::map<Integer, Used> outer = std::exchange(used_, {});
  for (ast::Branch& branch : one.branches) {
    for (ast::CaseLabel& label : branch.labels) {
      if (whole) {
        case_label(label, *type);
      }
    }
    std::map<Integer, Used> here = std::exchange(used_, {});
    list(branch.body);
    used_ = std::move(here);
  }
  used_ = std::move(outer);
}

void StatementChecker::case_label(ast::CaseLabel& label, const Type& type) {
  bool fine = expressions_.assigned(label.low, type);
  fine = (!label.high || expressions_.assigned(*label.high, type)) && fine;
  if (!fine) {
    return;
  }
  const Constant* low = constant_of(label.low);
  const Constant* high = label.high ? constant_of(*label.high) : low;
  const auto* first = low != nullptr ? std::get_if<Integer>(low) : nullptr;
  const auto* last = high != nullptr ? std::get_if<Integer>(high) : nullptr;
  if (first == nullptr || last == nullptr) {
    context_.error(label.low.at, "a value of a CASE must be known now, use a number or a CONSTANT");
    return;
  }
  const Used used{*first, *last, label.low.at};
  if (used.low > used.high) {
    context_.error(used.at, fmt::format("{}..{} is not a range, write the smaller value first", to_string(*low),
                                        to_string(*high)));
    return;
  }
  const auto behind = used_.upper_bound(used.high);
  if (behind != used_.begin() && std::prev(behind)->second.high >= used.low) {
    context_.error(used.at, fmt::format("this value was already handled at {}, remove one of them",
                                        to_string(std::prev(behind)->second.at)));
    return;
  }
  used_.emplace(used.low, used);
}

void StatementChecker::for_statement(Statement& one) {
  const Type* type = expressions_.writes().target(*one.target);
  const bool whole = type != nullptr && expressions_.is_whole(*type);
  if (type != nullptr && (!whole || one.target->kind != ast::Expression::Kind::Name)) {
    context_.error(one.target->at, "the variable of a FOR is a plain variable of a whole number type");
  }
  for (auto* part : {&one.value, &one.to, &one.by}) {
    if (*part && whole) {  // a step is not one of the values of a subrange
      expressions_.assigned(**part, part == &one.by ? *context_.elementary(type->elementary) : *type);
    } else if (*part) {
      expressions_.value(**part);
    }
  }
  const Constant* step = one.by ? constant_of(*one.by) : nullptr;
  if (step != nullptr && *step == Constant(Integer{0})) {
    context_.error(one.by->at, "a step of 0 never ends, use another one");
  }
  const Resolved* control = one.target->resolved.get();
  const void* variable = control == nullptr || type == nullptr ? nullptr
                         : control->variable != nullptr        ? static_cast<const void*>(control->variable)
                                                               : control->global;
  if (variable != nullptr) {
    context_.loop_variables.emplace_back(variable, one.at);
  }
  ++loops_;
  list(one.body);
  --loops_;
  if (variable != nullptr) {
    context_.loop_variables.pop_back();
  }
}

}  // namespace indurop::plc
