// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/start_statements.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "control/plc/check/starts.h"
#include "control/plc/model/make.h"

namespace indurop::plc {

using ast::Expression;
using ast::Section;

namespace {

constexpr std::size_t kGiven = 2;  // bInitRetains, bInCopyCode
constexpr std::uint64_t kMaxEach = 10'000;

Expression member_of(Expression object, std::string_view name) {
  Expression out = make::wrapped(Expression::Kind::Member, std::move(object));
  out.name = name;
  return out;
}

std::size_t unnamed(const ast::StartArguments& given) {
  return static_cast<std::size_t>(
      std::count_if(given.begin(), given.end(), [](const ast::Argument& one) { return one.name.empty(); }));
}

Expression number(const Place& at, std::int64_t value) {
  Expression out;
  out.at = at;
  out.value = static_cast<std::uint64_t>(value < 0 ? -value : value);
  if (value >= 0) {
    return out;
  }
  Expression negative = make::wrapped(Expression::Kind::Unary, std::move(out));
  negative.op = ast::Operator::Negate;
  return negative;
}

// Declares a variable of the method with a name that no user can write.
std::string counter(ast::Pou& method) {
  const std::string name = fmt::format("_start_{}_", method.variables.size());
  ast::Variable made = make::variable(Section::Temp, name, make::type(method.at, Elementary::Dint));
  made.at = method.at;
  method.variables.push_back(std::move(made));
  return name;
}

}  // namespace

namespace start {

Expression super_of(const Place& at) {
  return make::wrapped(Expression::Kind::Deref, make::name(at, "SUPER"));
}

ast::Statement run(Expression object, std::string_view method, std::vector<ast::Argument> arguments) {
  const Place at = object.at;
  return make::call_statement(make::call(at, member_of(std::move(object), method), std::move(arguments)));
}

std::vector<const Variable*> inputs_of(const Pou& method) {
  std::vector<const Variable*> out;
  for (const Variable& one : method.variables) {
    if (one.section == Section::Input || one.section == Section::InOut) {
      out.push_back(&one);
    }
  }
  return out;
}

const ast::TypeSpec& innermost(const ast::TypeSpec& spec) {
  return spec.kind == ast::TypeSpec::Kind::Array ? innermost(*spec.element) : spec;
}

}  // namespace start

const Pou* StartStatements::started(const Type* type) {
  if (type == nullptr) {
    return nullptr;
  }
  if (type->kind == Type::Kind::Array) {
    return started(type->element);
  }
  const bool found = type->kind == Type::Kind::Block && type->pou != nullptr && needs(*type->pou);
  return found ? type->pou : nullptr;
}

bool StartStatements::needs(const Pou& pou) {
  const auto [known, is_new] = needs_.emplace(&pou, false);
  if (!is_new) {
    return known->second;
  }
  const bool found = find_method(pou, kInit) != nullptr || needs_start(pou);
  needs_[&pou] = found;
  return found;
}

bool StartStatements::needs_start(const Pou& pou) {
  const auto known = needs_start_.find(&pou);
  if (known != needs_start_.end()) {
    return known->second;
  }
  const bool found = (pou.base != nullptr && needs_start(*pou.base)) ||
                     std::any_of(pou.variables.begin(), pou.variables.end(), [&](const Variable& one) {
                       return lasts(one) && (one.declared->late.has_value() || started(one.type) != nullptr);
                     });
  needs_start_[&pou] = found;
  return found;
}

bool StartStatements::lasts(const Variable& one) {
  const bool own = one.section == Section::Local || one.section == Section::Output;
  return own && !one.owner->is_callable() && !one.declared->is_static && one.global == nullptr;
}

void StartStatements::instances(ast::Pou* method, const Variable& one, ast::Body& to) {
  const ast::TypeSpec& spec = start::innermost(one.declared->type);
  elements(method, spec.starts, *one.type, make::name(one.declared->at, one.name), to);
}

// Starts all elements of an array: with the arguments of each of them, else in loops, whose variables `method` gets;
// null: it can have no further variables, so one statement per element.
void StartStatements::elements(ast::Pou* method, const std::vector<ast::StartArguments>& starts, const Type& type,
                               Expression object, ast::Body& to) {
  if (type.kind != Type::Kind::Array) {
    instance(starts.empty() ? ast::StartArguments() : starts.front(), type, std::move(object), to);
  } else if (starts.size() > 1) {
    listed(starts, type, object, to);
  } else if (method == nullptr && type.parts > kMaxEach) {
    context_.error(object.at, fmt::format("more than {} instances that are started in each call, declare them where "
                                          "they last",
                                          kMaxEach));
  } else if (method == nullptr) {
    each(starts, type, make::wrapped(Expression::Kind::Index, std::move(object)), to);
  } else {
    loops(*method, starts, type, object, to);
  }
}

void StartStatements::loops(ast::Pou& method, const std::vector<ast::StartArguments>& starts, const Type& type,
                            const Expression& object, ast::Body& to) {
  Expression element = make::wrapped(Expression::Kind::Index, object);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < type.dimensions.size(); ++i) {
    names.push_back(counter(method));
    element.operands.push_back(make::name(object.at, names.back()));
  }
  ast::Body body;
  elements(&method, starts, *type.element, std::move(element), body);
  for (std::size_t i = type.dimensions.size(); i-- > 0;) {
    ast::Statement loop;
    loop.kind = ast::Statement::Kind::For;
    loop.at = object.at;
    loop.target = make::name(object.at, names[i]);
    loop.value = number(object.at, type.dimensions[i].low);
    loop.to = number(object.at, type.dimensions[i].high);
    loop.body = std::exchange(body, {});
    body.push_back(std::move(loop));
  }
  std::move(body.begin(), body.end(), std::back_inserter(to));
}

void StartStatements::each(const std::vector<ast::StartArguments>& starts, const Type& type, const Expression& element,
                           ast::Body& to) {
  const std::size_t level = element.operands.size() - 1;
  if (level == type.dimensions.size()) {
    elements(nullptr, starts, *type.element, element, to);
    return;
  }
  for (std::int64_t i = type.dimensions[level].low; i <= type.dimensions[level].high; ++i) {
    Expression next = element;
    next.operands.push_back(number(element.at, i));
    each(starts, type, next, to);
  }
}

void StartStatements::listed(const std::vector<ast::StartArguments>& starts, const Type& type, const Expression& object,
                             ast::Body& to) {
  const Bounds& bounds = type.dimensions.front();
  if (type.dimensions.size() > 1 || type.element->kind == Type::Kind::Array || bounds.count() != starts.size()) {
    context_.error(object.at, fmt::format("values for FB_Init of {} instances are given, and there are {}",
                                          starts.size(), parts_of(type)));
    return;
  }
  for (std::size_t i = 0; i < starts.size(); ++i) {
    Expression element = make::wrapped(Expression::Kind::Index, object);
    element.operands.push_back(number(object.at, bounds.low + static_cast<std::int64_t>(i)));
    instance(starts[i], *type.element, std::move(element), to);
  }
}

// Starts the instances inside it, then the instance itself.
void StartStatements::instance(const ast::StartArguments& given, const Type& type, Expression object, ast::Body& to) {
  if (needs_start(*type.pou)) {
    to.push_back(start::run(object, kStart, {}));
  }
  const Pou* method = find_method(*type.pou, kInit);
  if (method == nullptr) {
    return;
  }
  const std::vector<const Variable*> inputs = start::inputs_of(*method);
  std::string missing;
  for (std::size_t i = kGiven + unnamed(given); i < inputs.size(); ++i) {
    const bool there = inputs[i]->declared->initial ||
                       std::any_of(given.begin(), given.end(),
                                   [&](const ast::Argument& one) { return same_name(one.name, inputs[i]->name); });
    missing += there ? "" : (missing.empty() ? "" : ", ") + inputs[i]->name + " := ...";
  }
  if (!missing.empty()) {
    context_.error(object.at, fmt::format("FB_Init of {0} wants values where an instance is declared: {0}({1})",
                                          type.pou->name, missing));
    return;
  }
  std::vector<ast::Argument> arguments;
  for (std::size_t i = 0; i < kGiven; ++i) {
    arguments.push_back(make::argument("", make::truth(object.at, false)));
  }
  arguments.insert(arguments.end(), given.begin(), given.end());
  to.push_back(start::run(std::move(object), kInit, std::move(arguments)));
}

}  // namespace indurop::plc
