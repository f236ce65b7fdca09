// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/expression_emitter.h"

#include <fmt/format.h>

#include "control/plc/check/designator.h"
#include "control/plc/check/expression_checker.h"
#include "control/plc/check/lifetime.h"
#include "control/plc/emit/object_emitter.h"
#include "control/plc/emit/operand_order.h"
#include "control/plc/library/standard.h"
#include "control/plc/model/characters.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using ast::Operator;
using Meaning = Resolved::Meaning;

std::string_view symbol_of(Operator op) noexcept {
  switch (op) {
    case Operator::Add:
      return "+";
    case Operator::Subtract:
      return "-";
    case Operator::Multiply:
      return "*";
    case Operator::Less:
      return "<";
    case Operator::Greater:
      return ">";
    case Operator::LessEqual:
      return "<=";
    case Operator::GreaterEqual:
      return ">=";
    case Operator::Equal:
      return "==";
    default:
      return "!=";
  }
}

std::string_view text_comparison(Operator op) noexcept {
  switch (op) {
    case Operator::Less:
      return "lt";
    case Operator::Greater:
      return "gt";
    case Operator::LessEqual:
      return "le";
    case Operator::GreaterEqual:
      return "ge";
    case Operator::Equal:
      return "eq";
    default:
      return "ne";
  }
}

// Returns whether the name of a constant is more informative than its value.
bool is_named(const Expression& expression) noexcept {
  return expression.kind == Expression::Kind::Name && expression.resolved->meaning != Meaning::Value;
}

bool is_this(const Expression& expression) noexcept {
  return expression.resolved->meaning == Meaning::This || expression.resolved->meaning == Meaning::Super;
}

bool joins_texts(const Expression& expression) noexcept {
  return expression.kind == Expression::Kind::Call && expression.resolved->function != nullptr &&
         expression.resolved->function->joins;
}

std::string converted(const std::string& text, const Expression& expression, const Type& to) {
  const Type& from = *expression.type;
  if (to.is_text()) {
    const bool exactly = expression.kind != Expression::Kind::Call && from.length == to.length;
    return exactly ? text : fmt::format("{}({})", cpp_type(to), text);
  }
  const bool same = to.kind != Type::Kind::Elementary || from.elementary == to.elementary;
  return same ? text : fmt::format("static_cast<{}>({})", cpp_type(to), text);
}

}  // namespace

std::string ExpressionEmitter::result_name(const Pou& pou) {
  return pou.name + "_result";
}

std::string ExpressionEmitter::value(const Expression& expression, const Type& to, bool exact) const {
  const Constant* known = constant_of(expression);
  if (to.kind == Type::Kind::Pointer) {
    return known != nullptr ? cpp_type(to) + "{}" : raw(expression);
  }
  if (to.kind == Type::Kind::Interface) {
    return known != nullptr                             ? cpp_type(to) + "{}"
           : expression.type->kind == Type::Kind::Block ? fmt::format("{}({})", cpp_type(to), raw(expression))
                                                        : raw(expression);
  }
  const bool scalar = to.kind == Type::Kind::Elementary || to.kind == Type::Kind::Enum;
  if (known != nullptr && scalar && !is_named(expression)) {
    if (to.is_text()) {
      Type own = to;
      own.length = exact ? characters_of(std::get<std::string>(*known), to.elementary) : to.length;
      return cpp_constant(*known, own, exact);
    }
    return cpp_constant(to.kind == Type::Kind::Enum ? *known : stored(*known, to), to, exact);
  }
  if (!exact && to.is_text() && joins_texts(expression)) {
    return library_call(expression, &to);
  }
  const std::string text = exact && to.is_text() ? raw(expression) : converted(raw(expression), expression, to);
  return exact || in_range_of(*expression.type, to) ? text : in_range(expression, text, to);
}

std::string ExpressionEmitter::in_range(const Expression& at, const std::string& text, const Type& to) const {
  return fmt::format("iec::in_range({}, {}, {}, {})", place(at.at), text, to.range->low, to.range->high);
}

std::string ExpressionEmitter::raw(const Expression& expression) const {
  switch (expression.kind) {
    case Expression::Kind::Literal:
      return cpp_constant(*constant_of(expression), *expression.type, true);
    case Expression::Kind::Name:
      return name(expression);
    case Expression::Kind::Direct:
      return global(*expression.resolved->global);
    case Expression::Kind::Member:
      return member(expression);
    case Expression::Kind::Bit:
      return expression.width == 1 ? fmt::format("iec::bit({}, {}U)", raw(expression.operands[0]), expression.bit)
                                   : fmt::format("iec::part<{}>({}, {}U)", cpp_type(*expression.type),
                                                 raw(expression.operands[0]), expression.bit);
    case Expression::Kind::Index:
      return index(expression);
    case Expression::Kind::Deref:
      if (is_this(expression.operands[0])) {
        return name(expression.operands[0]);
      }
      return fmt::format("iec::deref({}, {})", place(expression.at), raw(expression.operands[0]));
    case Expression::Kind::Call:
      if (expression.resolved->intrinsic != Resolved::Intrinsic::None) {
        return intrinsic(expression);
      }
      if (expression.resolved->cast) {
        const Resolved::Actual& one = expression.resolved->actuals.front();
        return fmt::format("static_cast<{}>({})", cpp_type(*expression.type), value(*one.argument->value, *one.type));
      }
      return expression.resolved->function != nullptr ? library_call(expression) : user_call(expression);
    case Expression::Kind::Unary:
      return unary(expression);
    case Expression::Kind::Binary:
      return binary(expression);
  }
  return "";
}

std::string ExpressionEmitter::name(const Expression& expression) const {
  const Resolved& resolved = *expression.resolved;
  if (resolved.meaning == Meaning::FunctionResult) {
    return result_name(pou_);
  }
  if (resolved.meaning == Meaning::Global) {
    return global(*resolved.global);
  }
  if (is_this(expression)) {
    return resolved.meaning == Meaning::This ? "(*this)"
                                             : fmt::format("static_cast<{}&>(*this)", cpp_type(*expression.type));
  }
  if (resolved.variable == nullptr) {
    return cpp_constant(*constant_of(expression), *expression.type, true);
  }
  const Variable& variable = *resolved.variable;
  const std::string text = variable.declared->of_instance
                               ? kept_name(variable)
                               : (expression.of_this ? "this->" : "") + cpp_name(std::string_view(variable.name));
  if (variable.section == ast::Section::InOut && !variable.owner->is_callable() && !variable.type->open) {
    if (pou_.owner != nullptr) {  // a method may run before or after the variables passed to a call exist
      return fmt::format("iec::given({}, {})", place(expression.at), text);
    }
    return "(*" + text + ")";
  }
  return variable.declared->edge == ast::Edge::None ? text : text + "_edge";
}

std::string ExpressionEmitter::global(const Global& global) const {
  const bool in_image = global.kind == Global::Kind::Own || global.kind == Global::Kind::Foreign;
  return (in_image ? "shared." : "plc::") + cpp_name(global);
}

std::string ExpressionEmitter::member(const Expression& expression) const {
  const Resolved& resolved = *expression.resolved;
  if (resolved.meaning == Meaning::Global) {
    return global(*resolved.global);
  }
  if (expression.operands[0].resolved->meaning == Meaning::Type) {
    return cpp_constant(*constant_of(expression), *expression.type, true);
  }
  const Type& base = *expression.operands[0].type;
  if (base.overlaps) {
    return fmt::format("iec::overlaid<{}>({})", cpp_type(*expression.type), raw(expression.operands[0]));
  }
  const bool as_is = base.kind == Type::Kind::Struct || base.block != nullptr;
  return raw(expression.operands[0]) + "." + (as_is ? expression.name : cpp_name(std::string_view(expression.name)));
}

// Emits ADR(x), SIZEOF(x), __ISVALIDREF(r).
std::string ExpressionEmitter::intrinsic(const Expression& expression) const {
  const Resolved& resolved = *expression.resolved;
  const Expression& of = *expression.arguments[0].value;
  if (resolved.intrinsic >= Resolved::Intrinsic::LowerBound) {
    return resolved.constant ? cpp_constant(*resolved.constant, *expression.type, true)
                             : fmt::format("{}.{}({}, {})", raw(of),
                                           resolved.intrinsic == Resolved::Intrinsic::LowerBound ? "low" : "high",
                                           place(expression.at), value(*expression.arguments[1].value));
  }
  if (resolved.intrinsic == Resolved::Intrinsic::Size) {
    return fmt::format("static_cast<std::uint32_t>(sizeof({}))", cpp_type(*resolved.operand));
  }
  if (resolved.intrinsic == Resolved::Intrinsic::IsValid) {
    return fmt::format("({}.base != nullptr)", raw(of));
  }
  if (const Expression* pointer = through_pointer(of)) {
    const bool itself = of.kind == Expression::Kind::Deref && pointer == &of.operands[0];
    return itself ? raw(*pointer) : fmt::format("iec::address_in({}, {})", raw(*pointer), raw(of));
  }
  return fmt::format("iec::address({}, {}{})", raw(of), raw(root_of(of)), ends_with_call(of) ? ", lifetime" : "");
}

// Emits access to one element through a pointer: only that element must exist, not the whole array.
std::string ExpressionEmitter::index_through_pointer(const Expression& expression) const {
  const Expression& base = expression.operands[0];
  const bool whole = base.type->kind == Type::Kind::Array;  // p^[i], else p[i]
  const std::string index =
      whole ? one_index(expression.operands[1], base.type->dimensions[0]) : value(expression.operands[1]);
  return fmt::format("iec::element<{}>({}, {}, static_cast<std::int64_t>({}))", cpp_type(*expression.type),
                     place(expression.at), raw(whole ? base.operands[0] : base), index);
}

std::string ExpressionEmitter::index(const Expression& expression) const {
  const Type& array = *expression.operands[0].type;
  if (array.is_text()) {
    const bool from_zero = !is_character(expression.type->elementary);  // as CODESYS counts
    return fmt::format("iec::character<{}, {}>({}, {}, static_cast<std::int64_t>({}))", cpp_type(*expression.type),
                       from_zero ? 0 : 1, place(expression.at), raw(expression.operands[0]),
                       value(expression.operands[1]));
  }
  const bool one = expression.operands.size() == 2;
  if (array.kind == Type::Kind::Pointer || (one && expression.operands[0].kind == Expression::Kind::Deref)) {
    return index_through_pointer(expression);
  }
  std::string text = raw(expression.operands[0]);
  if (array.open) {
    text += fmt::format(".at({}", place(expression.at));
    for (std::size_t i = 1; i < expression.operands.size(); ++i) {
      text += fmt::format(", static_cast<std::int64_t>({})", value(expression.operands[i]));
    }
    return text + ")";
  }
  for (std::size_t i = 1; i < expression.operands.size(); ++i) {
    text += "[" + one_index(expression.operands[i], array.dimensions[i - 1]) + "]";
  }
  return text;
}

std::string ExpressionEmitter::one_index(const Expression& expression, Bounds bounds) const {
  if (const Constant* known = constant_of(expression)) {
    return to_string(Constant(std::get<Integer>(*known) - Integer{bounds.low}));
  }
  const std::string text = value(expression);
  if (index_check_.is_needed(expression, bounds)) {
    return fmt::format("iec::index({}, {}, {}, {})", place(expression.at), text, bounds.low, bounds.high);
  }
  return bounds.low == 0
             ? text
             : fmt::format("{} - {}", text,
                           bounds.low < 0 ? fmt::format("({})", bounds.low) : fmt::format("{}", bounds.low));
}

std::string ExpressionEmitter::unary(const Expression& expression) const {
  const Expression& operand = expression.operands[0];
  const std::string text = value(operand, *operand.type, true);
  if (expression.op == Operator::Plus) {
    return text;
  }
  if (expression.op == Operator::Not) {
    return operand.type->is(Elementary::Bool) ? "!" + wrapped(text) : fmt::format("iec::bit_not({})", text);
  }
  if (!is_real(operand.type->elementary)) {
    return fmt::format("iec::neg({})", text);
  }
  return text.starts_with('-') ? fmt::format("-({})", text) : "-" + wrapped(text);  // "--x" would change x
}

std::string ExpressionEmitter::binary(const Expression& expression) const {
  if (expression.op >= Operator::Less && expression.op <= Operator::NotEqual) {
    return comparison(expression);
  }
  if (expression.op >= Operator::And) {
    return logic(expression);
  }
  if (expression.type->kind == Type::Kind::Pointer) {
    const std::string bytes = fmt::format("static_cast<std::int64_t>({})", value(expression.operands[1]));
    return fmt::format("iec::moved({}, {}{})", raw(expression.operands[0]),
                       expression.op == Operator::Subtract ? "-" : "", bytes);
  }
  const bool native =
      expression.op == Operator::Add || expression.op == Operator::Subtract || expression.op == Operator::Multiply;
  if (!native || !is_real(expression.type->elementary)) {
    return library_call(expression);
  }
  OperandOrder order({&expression.operands[0], &expression.operands[1]});
  const std::string a = order.take(expression.operands[0], value(expression.operands[0], *expression.type, true));
  const std::string b = order.take(expression.operands[1], value(expression.operands[1], *expression.type, true));
  return order.close(fmt::format("{} {} {}", wrapped(a), symbol_of(expression.op), wrapped(b)));
}

std::string ExpressionEmitter::comparison(const Expression& expression) const {
  const Type& type = *expression.resolved->operand;
  const bool texts = type.is_text();
  OperandOrder order({&expression.operands[0], &expression.operands[1]});
  const std::string a = order.take(expression.operands[0], value(expression.operands[0], type, texts));
  const std::string b = order.take(expression.operands[1], value(expression.operands[1], type, texts));
  return order.close(texts ? fmt::format("iec::{}({}, {})", text_comparison(expression.op), a, b)
                           : fmt::format("{} {} {}", wrapped(a), symbol_of(expression.op), wrapped(b)));
}

std::string ExpressionEmitter::logic(const Expression& expression) const {
  const Type& type = *expression.resolved->operand;
  const std::string left = value(expression.operands[0], type, true);
  const std::string right = value(expression.operands[1], type, true);
  const bool flags = type.is(Elementary::Bool);
  if (flags && expression.op != Operator::Xor) {  // C++ evaluates these from left to right, too
    return fmt::format("{} {} {}", wrapped(left), expression.op == Operator::And ? "&&" : "||", wrapped(right));
  }
  OperandOrder order({&expression.operands[0], &expression.operands[1]});
  const std::string a = order.take(expression.operands[0], left);
  const std::string b = order.take(expression.operands[1], right);
  if (flags) {
    return order.close(fmt::format("{} != {}", wrapped(a), wrapped(b)));
  }
  const char* name = expression.op == Operator::And ? "and" : expression.op == Operator::Or ? "or" : "xor";
  return order.close(fmt::format("iec::bit_{}({}, {})", name, a, b));
}

std::string ExpressionEmitter::assign_output(const ast::Argument& argument, const std::string& text,
                                             const Type& from) const {
  const Expression& target = *argument.value;
  Expression output;
  output.kind = Expression::Kind::Member;  // not a call: its type is exactly `from`
  output.type = &from;
  const std::string value = argument.negated ? "!" + text : converted(text, output, *target.type);
  return assign(target, in_range_of(from, *target.type) ? value : in_range(target, value, *target.type));
}

std::string ExpressionEmitter::assign(const Expression& target, const std::string& text) const {
  if (target.kind == Expression::Kind::Bit && target.operands[0].type->range) {
    const Bounds& range = *target.operands[0].type->range;
    return fmt::format("iec::set_bit_in_range({}, {}, {}U, {}, {}, {})", place(target.at), raw(target.operands[0]),
                       target.bit, text, range.low, range.high);
  }
  if (target.kind == Expression::Kind::Bit && target.width > 1) {
    return fmt::format("iec::set_part<{}>({}, {}U, {})", cpp_type(*target.type), raw(target.operands[0]), target.bit,
                       text);
  }
  if (target.kind == Expression::Kind::Bit) {
    return fmt::format("iec::set_bit({}, {}U, {})", raw(target.operands[0]), target.bit, text);
  }
  return fmt::format("{} = {}", raw(target), text);
}

}  // namespace indurop::plc
