// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/call_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "control/plc/check/expression_checker.h"
#include "control/plc/library/hidden.h"
#include "control/plc/model/make.h"

namespace indurop::plc {
namespace {

using ast::Argument;
using ast::Expression;

bool is_enable(const Argument& argument) {
  return same_name(argument.name, "EN") && !argument.output;
}
bool is_enable_out(const Argument& argument) {
  return same_name(argument.name, "ENO") && argument.output;
}

std::vector<std::string> names_of(const LibraryBlock& block, bool outputs) {
  std::vector<std::string> names;
  for (const LibraryParameter& one : outputs ? block.outputs : block.inputs) {
    names.push_back(one.name);
  }
  return names;
}

bool is_parameter(const Variable& variable, bool output) noexcept {
  return output ? variable.section == ast::Section::Output
                : variable.section == ast::Section::Input || variable.section == ast::Section::InOut;
}

bool has_body(const Pou& pou) noexcept {
  return !pou.tree->body.empty() || (pou.base != nullptr && has_body(*pou.base));
}

// Returns a parameter; for a method only its own: variables of its instance are accessible, but not parameters.
const Variable* parameter_of(const Pou& pou, const std::string& name) {
  const Variable* found = pou.find(upper(name));
  return found != nullptr && pou.owner != nullptr && found->owner != &pou ? nullptr : found;
}

// Returns whether a drawing may call an instance of the type by this name: its own, or that of a base or interface.
bool is_drawn_as(const Type& type, std::string_view drawn) {
  const std::string_view name = drawn.substr(drawn.rfind('.') + 1);  // without its namespace
  if (type.block != nullptr) {
    return find_block(name) == type.block;
  }
  const auto is_called = [&](const Pou* one) {
    return one != nullptr && same_name(std::string_view(one->name).substr(one->name.rfind('.') + 1), name);
  };
  for (const Pou* one = type.pou; one != nullptr; one = one->base) {
    if (is_called(one) || std::any_of(one->interfaces.begin(), one->interfaces.end(), is_called)) {
      return true;
    }
  }
  return false;
}

}  // namespace

// Records EN and ENO; returns false with an error if they are not allowed here.
bool CallChecker::take_enable(Expression& call, bool allowed) {
  Resolved& out = resolved(call);
  out.enable = nullptr;  // the call may have been checked before
  out.enable_out = nullptr;
  bool fine = true;
  for (Argument& argument : call.arguments) {
    if (!is_enable(argument) && !is_enable_out(argument)) {
      continue;
    }
    if ((is_enable(argument) ? out.enable : out.enable_out) != nullptr) {
      context_.error(argument.at, fmt::format("{} is given twice, remove one of them", argument.name));
    }
    if (!allowed && is_enable(argument) && argument.value && make::is_true(*argument.value)) {
      continue;
    }
    if (!allowed) {
      context_.error(argument.at, "EN and ENO need the call for themselves: as a statement, or x := F(EN := ...);");
      return false;
    }
    if (is_enable(argument)) {
      out.enable = argument.value ? &argument : nullptr;
      fine =
          (!argument.value || expressions_.assigned(*argument.value, *context_.elementary(Elementary::Bool))) && fine;
    } else if (argument.value) {
      out.enable_out = &argument;
      output_to(argument, *context_.elementary(Elementary::Bool));
    }
  }
  return fine;
}

// Returns the library functions to which the name can refer.
std::vector<const LibraryFunction*> CallChecker::overloads_of(const std::string& name, const Type* wanted) const {
  if (name.starts_with('@')) {
    const bool elementary = wanted != nullptr && wanted->kind == Type::Kind::Elementary;
    const LibraryFunction* hidden = find_hidden(name, elementary ? std::optional(wanted->elementary) : std::nullopt);
    return hidden == nullptr ? std::vector<const LibraryFunction*>() : std::vector{hidden};
  }
  if (same_name(name, "TRUNC") && wanted != nullptr && is_int(wanted->elementary)) {
    // The standard allows any whole number: the required type, else DINT.
    return find_functions(fmt::format("TRUNC_{}", name_of(wanted->elementary)));
  }
  auto out = find_functions(name);
  out = out.empty() ? find_typed(name) : std::move(out);
  const bool literal = context_.codesys() && out.size() == 1 && out.front()->cpp == "iec::to_literal";
  return literal ? find_functions("TO_STRING") : out;  // '42'
}

const Type* CallChecker::function(Expression& call, const Type* wanted, bool whole_side) {
  Expression& callee = call.operands[0];
  leave_out_library(callee);
  bool said = false;
  if (const Pou* found = expressions_.methods().method_of(callee, said)) {
    return take_enable(call, whole_side) ? expressions_.methods().method(call, *found) : nullptr;
  }
  if (said) {
    return nullptr;
  }
  if (callee.kind != Expression::Kind::Name) {
    if (callee.kind == Expression::Kind::Member && expressions_.typed(callee.operands[0], nullptr) == nullptr &&
        callee.operands[0].resolved->meaning != Resolved::Meaning::Namespace) {
      return nullptr;  // of an instance whose declaration has an error
    }
    context_.error(call.at, "a function block gives its results in its outputs: call it first, use instance.output");
    return nullptr;
  }
  if (!take_enable(call, whole_side)) {
    return nullptr;
  }
  const bool variable = context_.pou != nullptr && context_.pou->find(upper(callee.name)) != nullptr;
  if (const auto pou = context_.program.pou_names.find(upper(callee.name));
      pou != context_.program.pou_names.end() && !variable) {
    if (pou->second->tree->kind != ast::Pou::Kind::Function) {
      context_.error(call.at,
                     fmt::format("{} is not a function, declare an instance of it and call that", callee.name));
      return nullptr;
    }
    return user_function(call, *pou->second);
  }
  if (const auto generic = context_.program.generic_functions.find(upper(callee.name));
      generic != context_.program.generic_functions.end()) {
    const Pou* pou = arguments_.generic_function(call, *generic->second, wanted);
    return pou != nullptr ? user_function(call, *pou) : nullptr;
  }
  if (const Type* type = nullptr; intrinsics_.address_call(call, type)) {
    return type;
  }
  if (const Type* type = nullptr; expressions_.casts().enumeration_call(call, type)) {
    return type;
  }
  auto overloads = overloads_of(callee.name, wanted);
  if (!overloads.empty()) {
    return overloads_.library_function(call, overloads, wanted);
  }
  no_function(call);
  return nullptr;
}

// Long: one case for each kind of callable item, in the order in which names are searched.
void CallChecker::statement(Expression& call) {
  Expression& callee = call.operands[0];
  leave_out_library(callee);
  bool said = false;
  if (const Pou* found = expressions_.methods().method_of(callee, said)) {
    call.type = take_enable(call, true) ? expressions_.methods().method(call, *found) : nullptr;
    return;
  }
  if (said) {
    return;
  }
  const bool is_instance = callee.kind != Expression::Kind::Name ||
                           (context_.pou != nullptr && context_.pou->find(upper(callee.name)) != nullptr) ||
                           same_name(callee.name, "SUPER") || same_name(callee.name, "THIS") ||
                           expressions_.names().program_named(callee.name) != nullptr ||
                           context_.program.global_names.contains(upper(callee.name));
  if (!is_instance) {
    call.type = function(call, nullptr, true);
    return;
  }
  const Type* type = expressions_.typed(callee, nullptr);
  if (type == nullptr) {
    return;
  }
  if (type->kind != Type::Kind::Block) {
    context_.error(call.at, with_article(*type) + " cannot be called, only functions and function blocks can");
    return;
  }
  if (!call.name.empty() && !is_drawn_as(*type, call.name)) {
    context_.error(call.at, fmt::format("this is drawn as a {}, but declared as {}; draw that, or declare another "
                                        "instance",
                                        call.name, with_article(*type)));
    return;
  }
  expressions_.writes().note_call(callee);
  if (!arguments_.may_run(callee) || !take_enable(call, true)) {
    return;
  }
  call.type = type;
  if (context_.pou != nullptr) {
    context_.pou->calls_blocks = true;
    if (type->pou != nullptr) {
      context_.pou->uses.insert(type->pou);
      context_.pou->calls.insert(type->pou);
    }
  }
  if (type->pou != nullptr && type->pou->tree->kind == ast::Pou::Kind::Class) {
    context_.error(call.at, fmt::format("{} has no body, call a method or a function block in it", type->name));
    return;
  }
  if (type->block != nullptr) {
    library_block(call, *type->block);
  } else if (type->pou != nullptr) {
    if (type->pou->base != nullptr && type->pou->tree->body.empty() && has_body(*type->pou->base)) {
      context_.warning(call.at, fmt::format("{} has no statements, so this call runs none; to run those of {}, write "
                                            "SUPER^(); in {}",
                                            type->name, type->pou->base->name, type->name));
    }
    user_block(call, *type->pou);
  }
}

void CallChecker::output_to(Argument& argument, const Type& type) {
  const Type* to = expressions_.writes().target(*argument.value);
  if (to == nullptr) {
    return;
  }
  if (argument.negated && !type.is(Elementary::Bool)) {
    context_.error(argument.at, fmt::format("NOT needs a BOOL, and {} is {}", argument.name, with_article(type)));
  } else if (!context_.assignable(type, *to)) {
    context_.error(argument.value->at, fmt::format("the output {} is {}, which does not become {}", argument.name,
                                                   with_article(type), with_article(*to)));
  }
}

void CallChecker::library_block(Expression& call, const LibraryBlock& block) {
  Resolved& out = resolved(call);
  out.actuals.clear();
  std::size_t position = 0;
  std::set<const LibraryParameter*> given;
  for (Argument& argument : call.arguments) {
    // If the block has an input named EN, EN is that input.
    const std::size_t behind = position - std::min(position, block.inputs.size());
    const LibraryParameter* parameter = nullptr;
    if (argument.name.empty() && position < block.inputs.size()) {
      parameter = &block.inputs[position++];
    } else if (argument.name.empty() && behind < block.outputs.size()) {
      parameter = &block.outputs[behind];
      argument.output = true;
      ++position;
    } else {
      parameter = argument.output ? block.output(argument.name) : block.input(argument.name);
    }
    if (parameter == nullptr && (is_enable(argument) || is_enable_out(argument))) {
      continue;
    }
    if (parameter == nullptr) {
      context_.error(
          argument.at,
          argument.name.empty()
              ? fmt::format("{} has only {} inputs and outputs", block.name, block.inputs.size() + block.outputs.size())
              : fmt::format("{} has no {} '{}'{}", block.name, argument.output ? "output" : "input", argument.name,
                            did_you_mean(context_, argument.name, names_of(block, argument.output))));
      continue;
    }
    if (!given.insert(parameter).second) {
      context_.error(argument.at, fmt::format("{} is given twice, remove one of them", parameter->name));
    }
    if (!argument.value) {
      continue;
    }
    const Type* type = context_.elementary(std::get<Elementary>(parameter->type));
    if (argument.output) {
      output_to(argument, *type);
    } else {
      expressions_.assigned(*argument.value, *type);
    }
    out.actuals.push_back({&argument, type, nullptr, parameter->cpp});
  }
}

// Returns the parameters of arguments without names: the inputs; for more arguments all parameters as declared.
std::vector<const Variable*> CallChecker::by_position(const Expression& call, const Pou& pou) {
  std::vector<const Variable*> inputs;
  std::vector<const Variable*> all;
  const auto unnamed =
      std::count_if(call.arguments.begin(), call.arguments.end(), [](const Argument& one) { return one.name.empty(); });
  if (unnamed == 0) {
    return inputs;
  }
  for (const Variable* one : parameters_of(pou)) {
    if (same_name(one->name, "ENO")) {
      continue;
    }
    if (is_parameter(*one, false)) {
      inputs.push_back(one);
    }
    if (is_parameter(*one, false) || is_parameter(*one, true)) {
      all.push_back(one);
    }
  }
  return static_cast<std::size_t>(unnamed) > inputs.size() ? all : inputs;
}

void CallChecker::user_block(Expression& call, const Pou& pou) {
  Resolved& out = resolved(call);
  out.pou = &pou;
  out.actuals.clear();
  const std::vector<const Variable*> inputs = by_position(call, pou);
  std::set<const Variable*> given;
  std::size_t position = 0;
  for (Argument& argument : call.arguments) {
    if (is_enable(argument) || (is_enable_out(argument) && pou.find("ENO") == nullptr)) {
      continue;
    }
    const std::size_t at = argument.output ? position : position++;  // an argument with a name has a position, too
    const Variable* parameter =
        argument.name.empty() ? (at < inputs.size() ? inputs[at] : nullptr) : parameter_of(pou, argument.name);
    argument.output =
        argument.output || (argument.name.empty() && parameter != nullptr && is_parameter(*parameter, true));
    if (parameter == nullptr || !is_parameter(*parameter, argument.output)) {
      std::vector<std::string> known;
      for (const Variable* one : parameters_of(pou)) {
        if (!context_.diagnostics.full() && is_parameter(*one, argument.output)) {
          known.push_back(one->name);
        }
      }
      context_.error(argument.at,
                     argument.name.empty()
                         ? fmt::format("{} has only {} inputs and outputs", pou.name, inputs.size())
                         : fmt::format("{} has no {} '{}'{}", pou.name, argument.output ? "output" : "input",
                                       argument.name, did_you_mean(context_, argument.name, known)));
      continue;
    }
    if (!given.insert(parameter).second) {
      context_.error(argument.at, fmt::format("{} is given twice, remove one of them", parameter->name));
    }
    if (argument.output && argument.name.empty() && argument.value->kind == Expression::Kind::Literal) {
      context_.error(argument.at, fmt::format("{} has fewer inputs; this value stands at its output {}, remove it",
                                              pou.name, parameter->name));
      continue;
    }
    if (!argument.value || parameter->type == nullptr) {
      continue;
    }
    if (argument.output) {
      output_to(argument, *parameter->type);
    } else if (parameter->section == ast::Section::InOut) {
      arguments_.in_out(call, *argument.value, *parameter);
    } else if (parameter->type->kind == Type::Kind::Block) {
      arguments_.instance_input(*argument.value, *parameter);
    } else {
      expressions_.assigned(*argument.value, *parameter->type);
    }
    out.actuals.push_back({&argument, parameter->type, parameter, parameter->name});
  }
  for (const Variable* one : parameters_of(pou)) {
    if (one->section == ast::Section::InOut && !given.contains(one)) {
      context_.error(call.at, fmt::format("{} is VAR_IN_OUT and must be given in every call", one->name));
    }
  }
}

const Type* CallChecker::user_function(Expression& call, const Pou& pou) {
  if (context_.pou != nullptr) {
    context_.pou->uses.insert(&pou);
    context_.pou->calls.insert(&pou);
  }
  const std::size_t before = context_.diagnostics.errors();
  user_block(call, pou);
  if (context_.diagnostics.errors() != before || !arguments_.all_given(call, pou)) {
    return nullptr;
  }
  // In order of the declaration, including omitted ones.
  Resolved& out = resolved(call);
  std::vector<Resolved::Actual> ordered;
  for (const Variable* each : parameters_of(pou)) {
    const Variable& parameter = *each;
    if (parameter.owner != &pou) {
      continue;
    }
    const auto found = std::find_if(out.actuals.begin(), out.actuals.end(),
                                    [&](const Resolved::Actual& one) { return one.parameter == &parameter; });
    ordered.push_back(
        found != out.actuals.end() ? *found : Resolved::Actual{nullptr, parameter.type, &parameter, parameter.name});
  }
  out.actuals = std::move(ordered);
  return pou.result;
}

}  // namespace indurop::plc
