// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/intrinsic_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "control/plc/check/expression_checker.h"
#include "control/plc/check/lifetime.h"
#include "control/plc/model/make.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using Meaning = Resolved::Meaning;

const Type* pointer_to(Context& context, const Type& element, ast::PointerKind kind) {
  Type type;
  type.kind = Type::Kind::Pointer;
  type.element = &element;
  type.pointer = kind;
  return context.program.types.add(std::move(type));
}

struct Extent {
  std::uint64_t bytes = 0;
  std::uint64_t alignment = 1;
};

// Returns the layout of the type in the C++ of the program; none for function blocks.
std::optional<Extent> extent_of(const Type& type) {
  if (type.is_text()) {
    const std::uint64_t letter = type.is(Elementary::Wstring) ? sizeof(char16_t) : 1;
    return Extent{(type.length + 1) * letter, letter};
  }
  if (type.kind <= Type::Kind::Enum) {
    const std::uint64_t bytes = (bits_of(type.elementary) + 7) / 8;
    return Extent{bytes, bytes};
  }
  if (type.kind == Type::Kind::Pointer) {
    return Extent{24, 8};
  }
  if (type.kind == Type::Kind::Array && !type.open) {
    auto out = extent_of(*type.element);
    for (const Bounds& one : type.dimensions) {
      out = out ? std::optional(Extent{out->bytes * one.count(), out->alignment}) : std::nullopt;
    }
    return out;
  }
  if (type.kind != Type::Kind::Struct || !type.shared_name.empty()) {
    return std::nullopt;
  }
  Extent sum;
  if (type.overlaps) {
    return std::nullopt;  // known to C++ only
  }
  const auto round = [&](std::uint64_t to) { sum.bytes = (sum.bytes + to - 1) / to * to; };
  for (const Field& field : type.fields) {
    const auto one = extent_of(*field.type);
    if (!one) {
      return std::nullopt;
    }
    round(one->alignment);
    sum.bytes += one->bytes;
    sum.alignment = std::max(sum.alignment, one->alignment);
  }
  round(sum.alignment);
  return sum;
}

}  // namespace

// Checks ADR(x), REF(x), SIZEOF(x), __ISVALIDREF(r), LOWER_BOUND(a, 1). Returns false if it is none of these. `type` is
// null after an error.
bool IntrinsicChecker::address_call(Expression& call, const Type*& type) {
  const std::string name = upper(call.operands[0].name);
  if (name == "LOWER_BOUND" || name == "UPPER_BOUND") {
    type = bound_of(call, name == "LOWER_BOUND");
    return true;
  }
  const bool adr = name == "ADR" || name == "REF";
  if (!adr && name != "SIZEOF" && name != "__ISVALIDREF") {
    return false;
  }
  type = nullptr;
  if (call.arguments.size() != 1 || !call.arguments[0].value || call.arguments[0].output) {
    context_.error(call.at, fmt::format("{} takes one variable", name));
    return true;
  }
  Expression& of = *call.arguments[0].value;
  Resolved& out = resolved(call);
  if (adr) {
    const Type* found = expressions_.writes().reference(of);
    if (found != nullptr && expressions_.pointers().is_open(of)) {
      return true;
    }
    out.intrinsic = Resolved::Intrinsic::Address;
    if (found != nullptr) {
      expressions_.writes().note_address(of);
    }
    context_.pou->points_to_own = context_.pou->points_to_own || (found != nullptr && ends_with_call(of));
    type = found == nullptr
               ? nullptr
               : pointer_to(context_, *found, name == "ADR" ? ast::PointerKind::PointerTo : ast::PointerKind::RefTo);
  } else if (name == "SIZEOF") {
    type = size_of(call, of);
  } else {
    const Type* found = expressions_.pointers().reference_itself(of);
    const Variable* variable = of.kind == Expression::Kind::Name && of.resolved ? of.resolved->variable : nullptr;
    if (found != nullptr && variable != nullptr && variable->section == ast::Section::InOut) {
      call = make::truth(call.at, true);  // an argument of each call
      type = expressions_.value(call);
      return true;
    }
    if (found != nullptr && found->kind != Type::Kind::Pointer) {
      context_.error(of.at, fmt::format("{} is no reference", with_article(*found)));
      return true;
    }
    out.intrinsic = Resolved::Intrinsic::IsValid;
    type = found == nullptr ? nullptr : context_.elementary(Elementary::Bool);
  }
  return true;
}

// Checks LOWER_BOUND(a, 1), UPPER_BOUND(a, 2): a constant unless the array is ARRAY[*].
const Type* IntrinsicChecker::bound_of(Expression& call, bool lower) {
  if (call.arguments.size() != 2 || !call.arguments[0].value || !call.arguments[1].value) {
    context_.error(call.at, fmt::format("{} takes an array and the number of a dimension", call.operands[0].name));
    return nullptr;
  }
  const Type* array = expressions_.value(*call.arguments[0].value);
  const Type* dint = context_.elementary(Elementary::Dint);
  if (array == nullptr || !expressions_.assigned(*call.arguments[1].value, *dint)) {
    return nullptr;
  }
  if (array->kind != Type::Kind::Array) {
    context_.error(call.at,
                   fmt::format("{} has no bounds, {} is for arrays", with_article(*array), call.operands[0].name));
    return nullptr;
  }
  const Constant* known = constant_of(*call.arguments[1].value);
  const auto number = known != nullptr ? as_int64(*known) : std::nullopt;
  const auto most = static_cast<std::int64_t>(array->dimensions.size());
  if ((!array->open && !number) || (number && (*number < 1 || *number > most))) {
    context_.error(call.at,
                   fmt::format("the dimensions of {} are 1 to {}, as a number known now", to_string(*array), most));
    return nullptr;
  }
  Resolved& out = resolved(call);
  out.intrinsic = lower ? Resolved::Intrinsic::LowerBound : Resolved::Intrinsic::UpperBound;
  if (!array->open) {
    const Bounds& bounds = array->dimensions[static_cast<std::size_t>(number.value_or(1) - 1)];
    out.constant = Integer{lower ? bounds.low : bounds.high};
  }
  return dint;
}

const Type* IntrinsicChecker::size_of(Expression& call, Expression& of) {
  const auto elementary = of.kind == Expression::Kind::Name ? elementary_named(of.name) : std::nullopt;
  const Type* found = elementary ? context_.elementary(*elementary) : expressions_.typed(of, nullptr);
  if (found == nullptr && of.resolved && of.resolved->meaning == Meaning::Type) {
    found = of.type;
  }
  if (found == nullptr) {
    return nullptr;
  }
  if (found->open) {
    context_.error(of.at, "an ARRAY[*] has no size known now, use UPPER_BOUND() and SIZEOF() of an element");
    return nullptr;
  }
  Resolved& out = resolved(call);
  out.intrinsic = Resolved::Intrinsic::Size;
  out.operand = found;
  if (const auto extent = extent_of(*found)) {
    out.constant = Integer{extent->bytes};
    out.untyped = true;
    return context_.elementary(default_type(*out.constant));
  }
  return context_.elementary(Elementary::Udint);
}

}  // namespace indurop::plc
