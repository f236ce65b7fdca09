// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/type.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "control/plc/check/program.h"
#include "control/plc/check/saturating.h"

namespace indurop::plc {
namespace {

bool same_bounds(const Type& a, const Type& b) noexcept {
  return std::equal(a.dimensions.begin(), a.dimensions.end(), b.dimensions.begin(), b.dimensions.end(),
                    [](const Bounds& x, const Bounds& y) { return x.low == y.low && x.high == y.high; });
}

}  // namespace

std::string to_string(const Type& type) {
  if (type.kind == Type::Kind::Array) {
    std::string bounds;
    for (const Bounds& one : type.dimensions) {
      bounds += bounds.empty() ? "" : ",";
      bounds += type.open ? "*" : fmt::format("{}..{}", one.low, one.high);
    }
    return fmt::format("ARRAY[{}] OF {}", bounds, to_string(*type.element));
  }
  if (type.kind == Type::Kind::Pointer) {
    const char* word = type.pointer == ast::PointerKind::PointerTo ? "POINTER TO"
                       : type.pointer == ast::PointerKind::RefTo   ? "REF_TO"
                                                                   : "REFERENCE TO";
    return fmt::format("{} {}", word, type.element != nullptr ? to_string(*type.element) : "?");
  }
  if (!type.name.empty()) {
    return type.name;
  }
  if (type.is_text()) {
    return fmt::format("{}[{}]", name_of(type.elementary), type.length);
  }
  const std::string name(name_of(type.elementary));
  return type.range ? fmt::format("{} ({}..{})", name, type.range->low, type.range->high) : name;
}

std::string with_article(const Type& type) {
  const std::string name = to_string(type);
  const bool vowel = std::string_view("AEIOaeio").find(name[0]) != std::string_view::npos;
  return (vowel ? "an " : "a ") + name;
}

bool same_type(const Type& a, const Type& b) noexcept {
  if (&a == &b) {
    return true;
  }
  if (a.kind != b.kind) {
    return false;
  }
  switch (a.kind) {
    case Type::Kind::Elementary:
      return a.elementary == b.elementary && a.length == b.length;
    case Type::Kind::Array:
      return a.open == b.open && same_bounds(a, b) && same_type(*a.element, *b.element);
    case Type::Kind::Block:
    case Type::Kind::Interface:
      return a.pou == b.pou && a.block == b.block;
    case Type::Kind::Pointer:
      return a.element != nullptr && b.element != nullptr && same_type(*a.element, *b.element);
    case Type::Kind::Enum:
    case Type::Kind::Struct:  // TYPE Paint : Color := Red; is a Color that begins with another value
      return a.name == b.name && a.shared_name == b.shared_name;
  }
  return false;
}

bool stands_for(const Type& from, const Type& to) noexcept {
  const bool known = from.pou != nullptr && to.pou != nullptr && from.kind != Type::Kind::Pointer;
  return same_type(from, to) || (known && is_a(*from.pou, *to.pou));
}

bool in_range_of(const Type& from, const Type& to) noexcept {
  if (from.kind == Type::Kind::Array && to.kind == Type::Kind::Array) {
    return in_range_of(*from.element, *to.element);
  }
  if (from.kind == Type::Kind::Pointer && to.kind == Type::Kind::Pointer) {  // both can write to it
    return from.element == nullptr || to.element == nullptr || !same_type(*from.element, *to.element) ||
           same_range(*from.element, *to.element);
  }
  return !to.range || (from.range && from.range->low >= to.range->low && from.range->high <= to.range->high);
}

bool same_range(const Type& a, const Type& b) noexcept {
  if (a.kind == Type::Kind::Array && b.kind == Type::Kind::Array) {
    return same_range(*a.element, *b.element);
  }
  if (a.kind == Type::Kind::Pointer && b.kind == Type::Kind::Pointer) {
    return in_range_of(a, b);
  }
  return in_range_of(a, b) && in_range_of(b, a);
}

bool assignable(const Type& from, const Type& to, Dialect dialect) noexcept {
  if (to.kind == Type::Kind::Interface) {
    return stands_for(from, to);
  }
  if (from.kind == Type::Kind::Block) {
    return false;
  }
  if (from.kind == Type::Kind::Elementary && to.kind == Type::Kind::Elementary) {
    return widens(from.elementary, to.elementary) ||
           (dialect == Dialect::Codesys && converts_in_codesys(from.elementary, to.elementary));
  }
  const bool pointers = from.kind == Type::Kind::Pointer && to.kind == Type::Kind::Pointer;
  if (pointers && !in_range_of(from, to)) {
    return false;
  }
  if (pointers && to.pointer == ast::PointerKind::PointerTo) {
    return true;
  }
  if (pointers && from.element != nullptr && to.element != nullptr && stands_for(*from.element, *to.element)) {
    return true;
  }
  return same_type(from, to) && in_range_of(from, to);
}

bool is_private(const Type& type) noexcept {
  return type.is_private;
}

const Type* common_type(const Type& a, const Type& b, Dialect dialect) noexcept {
  if (a.is_text() && b.is_text() && a.elementary == b.elementary) {
    return a.length >= b.length ? &a : &b;
  }
  const bool a_to_b = assignable(a, b, dialect);
  const bool b_to_a = assignable(b, a, dialect);
  if (a_to_b && b_to_a && a.kind == Type::Kind::Elementary && b.kind == Type::Kind::Elementary) {
    if (is_real(a.elementary) && is_real(b.elementary)) {
      return bits_of(a.elementary) > bits_of(b.elementary) ? &a : &b;
    }
    return is_signed_int(b.elementary) ? &a : &b;  // same size: CODESYS uses the unsigned one
  }
  return a_to_b ? &b : b_to_a ? &a : nullptr;
}

std::uint64_t parts_of(const Type& type) noexcept {
  std::uint64_t sum = 0;
  constexpr auto kMaxParts = std::numeric_limits<std::uint64_t>::max();
  switch (type.kind) {
    case Type::Kind::Elementary:
      return type.is_text() ? (type.length + 8) / 8 : 1;
    case Type::Kind::Enum:
    case Type::Kind::Block:
    case Type::Kind::Pointer:
    case Type::Kind::Interface:
      return 1;
    case Type::Kind::Struct:
      for (const Field& field : type.fields) {
        if (__builtin_add_overflow(sum, field.type->parts, &sum)) {
          return kMaxParts;
        }
      }
      return sum;
    case Type::Kind::Array:
      sum = type.element->parts;
      for (const Bounds& one : type.dimensions) {
        if (__builtin_mul_overflow(sum, one.count(), &sum)) {
          return kMaxParts;
        }
      }
      return sum;
  }
  return sum;
}

IntegerLimits limits_of(Elementary type) noexcept {
  const unsigned bits = bits_of(type);
  const std::uint64_t all = bits == 64 ? std::numeric_limits<std::uint64_t>::max() : (std::uint64_t{1} << bits) - 1;
  if (is_signed_int(type)) {
    return {-static_cast<std::int64_t>(all / 2) - 1, all / 2};
  }
  return {0, all};
}

TypeTable::TypeTable() {
  for (std::size_t i = 0; i < kElementaryCount; ++i) {
    Type type;
    type.elementary = static_cast<Elementary>(i);
    type.length = type.is_text() ? kDefaultStringLength : 0;
    elementary_.push_back(add(std::move(type)));
  }
  for (const Elementary of : {Elementary::String, Elementary::Wstring}) {
    texts_[{of, kDefaultStringLength}] = elementary(of);
  }
}

const Type* TypeTable::text(Elementary of, std::size_t length) {
  const Type*& known = texts_[{of, length}];
  if (known == nullptr) {
    Type type;
    type.elementary = of;
    type.length = length;
    known = add(std::move(type));
  }
  return known;
}

namespace {

void measure(Type& type) noexcept {
  type.parts = parts_of(type);
  type.is_private = type.kind == Type::Kind::Block || type.kind == Type::Kind::Pointer ||
                    type.kind == Type::Kind::Interface || type.overlaps;
  if (type.kind == Type::Kind::Array) {
    type.is_private = type.element->is_private;
    type.fields_inside = type.element->fields_inside;
    type.depth = type.element->depth + 1;
    type.pointers = type.element->pointers;
  }
  if (type.kind == Type::Kind::Pointer) {
    type.pointers = 1 + (type.element != nullptr ? type.element->pointers : 0);
  }
  if (type.kind == Type::Kind::Struct) {
    type.fields_inside = 1;
    type.depth = 0;
    type.is_private = type.is_private || type.fields.empty();
  }
  for (std::size_t i = 0; i < type.fields.size(); ++i) {
    const Field& field = type.fields[i];
    type.field_names.try_emplace(upper(field.name), i);
    type.is_private = type.is_private || field.type->is_private;
    type.fields_inside = sum_of(type.fields_inside, field.type->fields_inside);
    type.depth = std::max(type.depth, field.type->depth);
  }
  type.depth += type.kind == Type::Kind::Struct ? 1 : 0;
}

}  // namespace

Type* TypeTable::add(Type type) {
  measure(type);
  has_pointers_ = has_pointers_ || type.kind == Type::Kind::Pointer;
  has_aliases_ = has_aliases_ || has_pointers_ || type.overlaps;
  return &types_.emplace_back(std::move(type));
}

}  // namespace indurop::plc
