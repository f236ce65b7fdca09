// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/overload.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "control/plc/check/bare_number.h"
#include "control/plc/check/expression_checker.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using ast::Operator;

std::string_view function_of(Operator op) noexcept {
  switch (op) {
    case Operator::Add:
      return "ADD";
    case Operator::Subtract:
      return "SUB";
    case Operator::Multiply:
      return "MUL";
    case Operator::Divide:
      return "DIV";
    case Operator::Modulo:
      return "MOD";
    default:
      return "EXPT";
  }
}

bool is_bit_string(const Type& type) noexcept {
  return type.kind == Type::Kind::Elementary && is_bit(type.elementary) && !type.is(Elementary::Bool);
}

bool untyped(const Expression& expression) noexcept {
  return expression.resolved->untyped;
}

// In CODESYS a bit string is a number, and a number has bits.
bool generic_accepts(Generic generic, const Type& type, bool codesys) noexcept {
  if (generic == Generic::Any || type.kind != Type::Kind::Elementary) {
    return generic == Generic::Any;
  }
  const Elementary own = type.elementary;
  const bool counts = codesys && is_bit(own) && own != Elementary::Bool;
  return accepts(generic, own) || (counts && (generic == Generic::AnyNum || generic == Generic::AnyInt)) ||
         (codesys && is_int(own) && generic == Generic::AnyBit);
}

std::string types_of(const std::vector<Expression*>& inputs) {
  std::string text;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    text += i == 0 ? "" : i + 1 == inputs.size() ? " and " : ", ";
    text += to_string(*inputs[i]->type);
  }
  return text;
}

// Returns a hint if a number without a unit is combined with a time.
std::string missing_unit(const std::vector<Expression*>& inputs) {
  if (std::none_of(inputs.begin(), inputs.end(), [](const Expression* one) { return untyped(*one); })) {
    return {};
  }
  for (const Expression* one : inputs) {
    if (std::string hint = untyped(*one) ? std::string() : unit_hint(*one->type); !hint.empty()) {
      return hint;
    }
  }
  return {};
}

// Returns whether both inputs share one type. Length and position in a text have separate types.
bool same_group(const LibraryFunction& function, std::size_t a, std::size_t b) noexcept {
  const auto* result = std::get_if<Elementary>(&function.result);
  const bool counts = result != nullptr && is_text(*result) && function.input(a).type == LibraryType(Generic::AnyInt);
  return function.input(a).type == function.input(b).type && (a == b || !counts);
}

// Returns true for functions that compare values of one enumeration, as = and <> do.
bool compares_one_enumeration(const LibraryFunction& function, const std::vector<Expression*>& inputs) noexcept {
  const bool compares = function.name == "EQ" || function.name == "NE";
  return compares && std::all_of(inputs.begin(), inputs.end(), [&](const Expression* one) {
           return one->type->kind == Type::Kind::Enum && same_type(*one->type, *inputs.front()->type);
         });
}

}  // namespace

// Returns the values by position; none after an error.
std::optional<OverloadResolver::Inputs> OverloadResolver::positions(Expression& call, const LibraryFunction& first) {
  Inputs inputs;
  std::size_t next = 0;
  for (ast::Argument& argument : call.arguments) {
    if (same_name(argument.name, "EN") || same_name(argument.name, "ENO")) {
      continue;
    }
    const auto position = argument.name.empty() ? std::optional(next) : first.position(argument.name);
    ++next;
    constexpr std::size_t kMostInputs = 64;
    if (!position || argument.output || *position >= kMostInputs) {
      std::vector<std::string> known;
      for (const LibraryParameter& one : first.inputs) {
        known.push_back(one.name);
      }
      context_.error(argument.at, fmt::format("{} has no {} '{}'{}", first.name, argument.output ? "output" : "input",
                                              argument.name, did_you_mean(context_, argument.name, known)));
      return std::nullopt;
    }
    inputs.resize(std::max(inputs.size(), *position + 1));
    if (inputs[*position] != nullptr || !argument.value) {
      context_.error(argument.at, fmt::format("the input {} needs exactly one value", first.input(*position).name));
      return std::nullopt;
    }
    inputs[*position] = &*argument.value;
  }
  if (!first.extensible && inputs.size() > first.inputs.size()) {
    context_.error(call.at, fmt::format("{} takes {} values, not {}", first.name, first.inputs.size(), inputs.size()));
    return std::nullopt;
  }
  if (std::find(inputs.begin(), inputs.end(), nullptr) != inputs.end()) {
    context_.error(call.at, fmt::format("{} has inputs without a value, give all of them", first.name));
    return std::nullopt;
  }
  return inputs;
}

// Returns the common type of numbers without a type, if one of them is computed: EQ(MAX(300, 1) * 300, 2.5). Null if
// none is.
const Type* OverloadResolver::widest_computed(const Inputs& inputs, const LibraryFunction& function, Generic generic) {
  std::optional<Elementary> widest;
  bool computed = false;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (function.input(i).type != LibraryType(generic) || !is_bare(*inputs[i], context_.program)) {
      continue;
    }
    computed = computed || computes(*inputs[i]);
    const Elementary own = widest_of(*inputs[i], context_.program);
    widest = widest == Elementary::Lreal ? widest : own;
  }
  return computed && widest ? context_.elementary(*widest) : nullptr;
}

// Checks first the inputs that have a type, which numbers without one take if the context requires none: MAX(d, 807 *
// MIN(1, 2)).
bool OverloadResolver::input_values(const Inputs& inputs, const std::vector<const LibraryFunction*>& overloads,
                                    const Type* wanted) {
  const LibraryFunction& first = *overloads.front();
  std::map<Generic, const Type*> known_types;
  bool fine = true;
  for (const bool bare : {false, true}) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (is_bare(*inputs[i], context_.program) != bare) {
        continue;
      }
      const LibraryType type = first.input(i).type;
      const auto* fixed = overloads.size() == 1 ? std::get_if<Elementary>(&type) : nullptr;
      const auto* generic = std::get_if<Generic>(&type);
      const Type* hint = fixed != nullptr ? context_.elementary(*fixed) : type == first.result ? wanted : nullptr;
      if (hint == nullptr && generic != nullptr && bare) {
        hint = known_types[*generic] != nullptr ? known_types[*generic] : widest_computed(inputs, first, *generic);
      }
      const Type* found = expressions_.value(*inputs[i], hint);
      fine = found != nullptr && fine;
      if (generic != nullptr && found != nullptr && found->kind == Type::Kind::Elementary &&
          is_num(found->elementary) && !untyped(*inputs[i])) {
        const Type* plain = context_.elementary(found->elementary);
        const Type*& known = known_types[*generic];
        known = known == nullptr ? plain : context_.common_type(*known, *plain);
      }
    }
  }
  return fine;
}

const Type* OverloadResolver::library_function(Expression& call, std::vector<const LibraryFunction*> overloads,
                                               const Type* wanted) {
  if (wanted == nullptr && is_bare(call, context_.program) && computes(call)) {  // without any type, none is too small
    wanted = context_.elementary(widest_of(call, context_.program));
  }
  const auto found = positions(call, *overloads.front());
  if (!found || !input_values(*found, overloads, wanted)) {
    return nullptr;
  }
  const Inputs& inputs = *found;
  const LibraryFunction& first = *overloads.front();
  const bool counts = context_.codesys() || first.name.starts_with("TO_") || compares_one_enumeration(first, inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (counts && inputs[i]->type->kind == Type::Kind::Enum && first.input(i).type != LibraryType(Generic::Any)) {
      expressions_.casts().cast(*inputs[i], *context_.elementary(inputs[i]->type->elementary));
    }
  }
  const bool to_text = first.name == "TO_STRING" || first.name == "TO_WSTRING";
  if (to_text && !context_.codesys() && inputs.size() == 1 && is_bit_string(*inputs[0]->type)) {
    overloads = find_functions(fmt::format("{}_{}", name_of(inputs[0]->type->elementary), first.name));  // '16#2a'
  }
  const Type* result = choose(call, overloads, inputs, wanted);
  if (result == nullptr) {
    return nullptr;
  }
  Resolved& out = resolved(call);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    for (const ast::Argument& argument : call.arguments) {
      if (argument.value && &*argument.value == inputs[i]) {
        out.actuals[i].argument = &argument;
      }
    }
  }
  return result;
}

const Type* OverloadResolver::operation(Expression& expression, const Type* wanted) {
  return choose(expression, find_functions(function_of(expression.op)),
                {&expression.operands[0], &expression.operands[1]}, wanted);
}

const Type* OverloadResolver::choose(Expression& at, const std::vector<const LibraryFunction*>& overloads,
                                     const Inputs& inputs, const Type* wanted) {
  std::optional<Choice> best;
  for (const LibraryFunction* one : overloads) {
    auto choice = match(*one, inputs, wanted);
    if (choice && (!best || choice->cost < best->cost)) {
      best = std::move(choice);
    }
  }
  if (best) {
    apply(at, *best, inputs);
    return best->result;
  }
  const LibraryFunction& first = *overloads.front();
  const bool right_count =
      first.extensible ? inputs.size() >= first.inputs.size() : inputs.size() == first.inputs.size();
  if (!right_count) {
    context_.error(at.at, fmt::format("{} takes {}{} values, not {}", first.name, first.extensible ? "at least " : "",
                                      first.inputs.size(), inputs.size()));
  } else {
    const bool scales = first.name == "MUL" || first.name == "DIV";
    const bool turned = first.name == "MUL" && inputs[1]->type->is(Elementary::Time) &&
                        inputs[0]->type->kind == Type::Kind::Elementary && is_num(inputs[0]->type->elementary);
    const std::string unit = turned ? "; write the TIME first" : scales ? std::string() : missing_unit(inputs);
    context_.error(at.at, fmt::format("{} does not take {}{}", first.name, types_of(inputs),
                                      unit.empty() ? ", convert them" : unit));
  }
  return nullptr;
}

std::optional<OverloadResolver::Choice> OverloadResolver::match(const LibraryFunction& function, const Inputs& inputs,
                                                                const Type* wanted) {
  const bool right_count =
      function.extensible ? inputs.size() >= function.inputs.size() : inputs.size() == function.inputs.size();
  if (!right_count) {
    return std::nullopt;
  }
  Choice out;
  out.function = &function;
  std::map<Generic, const Type*> groups;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const LibraryType input_type = function.input(i).type;
    const Type* type = nullptr;
    if (const auto* fixed = std::get_if<Elementary>(&input_type)) {
      type = context_.elementary(*fixed);
    } else {
      // The required type of the result applies to the inputs only if they have its type.
      type = group_type(function, i, inputs, function.result == input_type ? wanted : nullptr);
      groups[std::get<Generic>(input_type)] = type;
    }
    const auto cost = type != nullptr ? cost_of(*inputs[i], *type) : std::nullopt;
    if (!cost) {
      return std::nullopt;
    }
    out.cost += *cost;
    out.types.push_back(type);
  }
  if (const auto* fixed = std::get_if<Elementary>(&function.result)) {
    out.result = context_.elementary(*fixed);
  } else {
    out.result = groups[std::get<Generic>(function.result)];
  }
  return out.result != nullptr ? std::optional(std::move(out)) : std::nullopt;
}

// Returns 0: the type itself, 1: widened; none: cannot be used.
std::optional<int> OverloadResolver::cost_of(const Expression& input, const Type& type) {
  if (untyped(input)) {
    return adapts(*input.resolved->constant, type) ? std::optional(0) : std::nullopt;
  }
  if (!context_.assignable(*input.type, type)) {
    return std::nullopt;
  }
  return same_type(*input.type, type) || type.is_text() ? 0 : 1;
}

// Returns the common type of all inputs in the group of this one; null if there is none.
const Type* OverloadResolver::group_type(const LibraryFunction& function, std::size_t member, const Inputs& inputs,
                                         const Type* wanted) {
  const Generic generic = std::get<Generic>(function.input(member).type);
  const Type* group = nullptr;
  bool first = true;
  for (const bool numbers : {false, true}) {  // numbers without a type join the others
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (!same_group(function, member, i) || untyped(*inputs[i]) != numbers) {
        continue;
      }
      if (numbers) {
        group = join_untyped(generic, group, *inputs[i], wanted);
      } else {
        group = first ? inputs[i]->type : context_.common_type(*group, *inputs[i]->type);
      }
      first = false;
      if (group == nullptr) {
        return nullptr;
      }
    }
  }
  if (group != nullptr && group->kind == Type::Kind::Elementary && group->range) {
    group = context_.elementary(group->elementary);
  }
  if (group != nullptr && !generic_accepts(generic, *group, context_.codesys())) {
    for (const Elementary real : {Elementary::Real, Elementary::Lreal}) {
      if (generic == Generic::AnyReal && context_.assignable(*group, *context_.elementary(real))) {
        return context_.elementary(real);
      }
    }
    return nullptr;
  }
  return group;
}

// Returns the type of the group after a number without a type has joined it.
const Type* OverloadResolver::join_untyped(Generic generic, const Type* group, const Expression& input,
                                           const Type* wanted) {
  const Constant& number = *input.resolved->constant;
  if (group != nullptr && adapts(number, *group)) {
    return group;
  }
  const bool helps = wanted != nullptr && wanted->kind == Type::Kind::Elementary &&
                     generic_accepts(generic, *wanted, context_.codesys()) && adapts(number, *wanted);
  if (group == nullptr && helps) {
    return context_.elementary(wanted->elementary);
  }
  Elementary own = default_type(number);
  if (generic == Generic::AnyReal) {
    own = Elementary::Lreal;
  } else if (generic == Generic::AnyBit) {
    own = fits(number, *context_.elementary(Elementary::Word))    ? Elementary::Word
          : fits(number, *context_.elementary(Elementary::Dword)) ? Elementary::Dword
                                                                  : Elementary::Lword;
  }
  const Type* type = context_.elementary(own);
  return group == nullptr ? type : context_.common_type(*group, *type);
}

// The function of DIV and / where a REAL may become infinite.
const LibraryFunction& infinite_division() {
  static const LibraryFunction kMade = [] {
    LibraryFunction made = *find_functions("DIV").front();
    made.cpp = "iec::quotient";
    made.faults = false;
    return made;
  }();
  return kMade;
}

void OverloadResolver::apply(Expression& at, const Choice& choice, const Inputs& inputs) {
  Resolved& out = resolved(at);
  out.function = choice.function;
  const bool real = choice.result != nullptr && is_real(choice.result->elementary);
  const bool divides = choice.function->cpp == "iec::div";
  if (context_.program.infinite_division && real && divides) {
    out.function = &infinite_division();
  }
  const auto whole_number = [&](const Expression* one) {
    return is_bare(*one, context_.program) && widest_of(*one, context_.program) == Elementary::Lint;
  };
  if (divides && real && std::all_of(inputs.begin(), inputs.end(), whole_number)) {  // 1 / 2, which is known, is 0
    context_.warning(at.at, fmt::format("this division of whole numbers becomes one of {}, because that is wanted; "
                                        "write its numbers as 2.0 to say so",
                                        name_of(choice.result->elementary)));
  }
  for (std::size_t i = 1; (choice.function->name == "EQ" || choice.function->name == "NE") && i < inputs.size(); ++i) {
    expressions_.operations().warn_about_exactness(at.at, *choice.types[i], *inputs[i - 1], *inputs[i]);
  }
  out.actuals.clear();
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    adapt(*inputs[i], *choice.types[i]);
    out.actuals.push_back({nullptr, choice.types[i], nullptr, ""});
  }
}

}  // namespace indurop::plc
