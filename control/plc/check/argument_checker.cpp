// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/argument_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "control/plc/check/bare_number.h"
#include "control/plc/check/designator.h"
#include "control/plc/check/expression_checker.h"
#include "control/plc/check/generic_functions.h"

namespace indurop::plc {
namespace {

using ast::Argument;
using ast::Expression;

// Returns true for an array with the same number of dimensions and the same elements, whatever its bounds.
bool fits_open(const Type& type, const Type& wanted) noexcept {
  return type.kind == Type::Kind::Array && type.dimensions.size() == wanted.dimensions.size() &&
         same_type(*type.element, *wanted.element) && same_range(*type.element, *wanted.element);
}

// Returns the parameter of the argument if it has a type such as ANY_NUM. Inputs increment `position`.
const ast::Variable* generic_parameter(const ast::Pou& tree, const Argument& argument, std::size_t& position) {
  std::size_t at = 0;
  const std::size_t wanted = argument.output ? position : position++;
  for (const ast::Variable& one : tree.variables) {
    const bool given = one.section == ast::Section::Input || one.section == ast::Section::InOut;
    if (given && (argument.name.empty() ? at++ == wanted : same_name(one.name, argument.name))) {
      return generic_name(one.type).empty() ? nullptr : &one;
    }
  }
  return nullptr;
}

}  // namespace

void ArgumentChecker::in_out(const Expression& call, Expression& given, const Variable& parameter) {
  const Type* type = expressions_.writes().reference(given);
  if (context_.pou != nullptr && call.operands[0].kind == Expression::Kind::Name) {
    context_.pou->given[upper(call.operands[0].name + "." + parameter.name)] = given;
  }
  const Type& wanted = *parameter.type;
  if (type != nullptr && wanted.open && fits_open(*type, wanted)) {
    return;
  }
  if (type != nullptr && !(same_type(*type, wanted) && same_range(*type, wanted)) &&
      !(type->kind == Type::Kind::Block && stands_for(*type, wanted))) {
    context_.error(given.at, fmt::format("{} is VAR_IN_OUT and needs a variable of type {}, not {}", parameter.name,
                                         to_string(wanted), with_article(*type)));
  }
}

// Checks that a call without names passes each input that has no initial value of its own; returns false after an
// error. A call with names may omit any input, or all.
bool ArgumentChecker::all_given(const Expression& call, const Pou& pou) {
  const std::vector<Resolved::Actual>& actuals = call.resolved->actuals;
  const bool with_names = std::none_of(actuals.begin(), actuals.end(),
                                       [](const Resolved::Actual& one) { return one.argument->name.empty(); });
  const auto needs_value = [](const Variable& one) {
    return one.section == ast::Section::Input && !one.declared->initial && !same_name(one.name, "EN");
  };
  if (with_names) {
    const auto& all = parameters_of(pou);
    const auto first = std::find_if(all.begin(), all.end(), [&](const Variable* one) { return needs_value(*one); });
    if (actuals.empty() && call.resolved->enable == nullptr && first != all.end()) {
      context_.warning(call.at, fmt::format("{} is called without a value for any input, so {} has that of its type; "
                                            "give it",
                                            pou.name, (*first)->name));
    }
    return true;
  }
  for (const Variable* each : parameters_of(pou)) {
    const Variable& one = *each;
    const bool given =
        std::any_of(actuals.begin(), actuals.end(), [&](const auto& actual) { return actual.parameter == &one; });
    if (needs_value(one) && !given) {
      context_.error(call.at, fmt::format("{} needs a value for its input {}, give it", pou.name, one.name));
      return false;
    }
  }
  return true;
}

// Checks an instance as an input: it is copied in its state at the call.
void ArgumentChecker::instance_input(Expression& given, const Variable& parameter) {
  const Type* type = expressions_.typed(given, nullptr);
  if (type != nullptr && !same_type(*type, *parameter.type)) {
    context_.error(given.at, fmt::format("{} needs an instance of {}, not {}", parameter.name,
                                         to_string(*parameter.type), with_article(*type)));
  }
}

// Returns the function for the types of the inputs. All inputs of one generic type have one type, as in the library.
// `wanted`: the required type of the result; numbers without a type take it if no other input has a type.
const Pou* ArgumentChecker::generic_function(Expression& call, const ast::Pou& tree, const Type* wanted) {
  std::map<std::string, const Type*> types;
  const std::string of_result = tree.result ? generic_name(*tree.result) : "";
  for (const bool bare : {false, true}) {  // numbers without a type take that of the others
    std::size_t position = 0;
    for (Argument& argument : call.arguments) {
      const ast::Variable* parameter = generic_parameter(tree, argument, position);
      if (parameter == nullptr || !argument.value || is_bare(*argument.value, context_.program) != bare) {
        continue;
      }
      const std::string generic = generic_name(parameter->type);
      Expression checked = *argument.value;  // the call itself is checked once its function is known
      const Type*& known = types[generic];
      const bool asked = known == nullptr && bare && generic == of_result && wanted != nullptr;
      const Type* type = expressions_.value(checked, asked ? wanted : known);
      if (type == nullptr) {
        return nullptr;
      }
      if (asked && checked.resolved->untyped && generic_takes(generic, *wanted) &&
          adapts(*checked.resolved->constant, *wanted)) {
        known = wanted->range ? context_.elementary(wanted->elementary) : wanted;
      }
      const bool adapts_to =
          known != nullptr && checked.resolved->untyped && adapts(*checked.resolved->constant, *known);
      const Type* common = known == nullptr || adapts_to ? known : context_.common_type(*known, *type);
      if (!adapts_to && ((known != nullptr && common == nullptr) || !generic_takes(generic, *type))) {
        context_.error(argument.value->at,
                       fmt::format("{} is {} and does not take {}{}", parameter->name, generic, with_article(*type),
                                   known != nullptr ? " together with " + with_article(*known) : ""));
        return nullptr;
      }
      known = known == nullptr ? type : common;
      if (checked.kind == Expression::Kind::Call && checked.resolved->pou != nullptr && checked.type == type &&
          !type->is_reference()) {  // otherwise nested calls would be checked 2, 4, 8 times
        checked.resolved->settled = true;
        *argument.value = std::move(checked);
      }
    }
  }
  return function_for(context_, tree, types, call.at);
}

// Checks the instance of a call: not an input, which is only a copy of the argument.
bool ArgumentChecker::may_run(const Expression& callee) {
  const Resolved* root = root_of(callee).resolved.get();
  const bool copy = root != nullptr && root->variable != nullptr && root->variable->section == ast::Section::Input &&
                    root->variable->type != nullptr && root->variable->type->kind == Type::Kind::Block &&
                    root->variable->owner == context_.pou;
  if (copy && !context_.codesys()) {
    context_.error(callee.at, fmt::format("'{}' is an input, a copy of the instance that was given; declare it as "
                                          "VAR_IN_OUT to call that one",
                                          root->variable->name));
  }
  return !copy || context_.codesys();
}

}  // namespace indurop::plc
