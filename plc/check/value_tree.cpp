// SPDX-License-Identifier: Apache-2.0
#include "plc/check/value_tree.h"

#include <algorithm>

#include "plc/check/expression_checker.h"

namespace indurop::plc {
namespace {

using Kind = ast::Initial::Kind;

bool is_zero(const Constant& value) noexcept {
  return value == Constant(false) || value == Constant(Integer{0}) || value == Constant(std::string()) ||
         (std::holds_alternative<double>(value) && std::get<double>(value) == 0);
}

ValueTree zero() {
  ValueTree out;
  out.zero = true;
  return out;
}

ValueTree leaf(Constant value) {
  ValueTree out;
  out.zero = is_zero(value);
  out.value = std::move(value);
  return out;
}

// Elements of the dimensions from `level` on; takes them from the front of `list`.
ValueTree rows(const Type& array, std::size_t level, const std::vector<const ast::Initial*>& list, std::size_t& next) {
  if (level == array.dimensions.size()) {
    return initial_value(*array.element, next < list.size() ? list[next++] : nullptr);
  }
  ValueTree out;
  const std::uint64_t count = array.dimensions[level].count();
  if (next >= list.size()) {  // only defaults from here
    out.parts.push_back(rows(array, level + 1, list, next));
    out.equal_parts = true;
    return out.parts[0].zero ? zero() : out;
  }
  const std::size_t before = next;
  for (std::uint64_t i = 0; i < count; ++i) {
    out.parts.push_back(rows(array, level + 1, list, next));
  }
  const bool one_value = next - before >= 1 && std::all_of(list.begin() + static_cast<std::ptrdiff_t>(before),
                                                           list.begin() + static_cast<std::ptrdiff_t>(next),
                                                           [&](const auto* one) { return one == list[before]; });
  if (std::all_of(out.parts.begin(), out.parts.end(), [](const ValueTree& part) { return part.zero; })) {
    return zero();
  }
  if (one_value && level + 1 == array.dimensions.size() && next - before == count) {
    out.parts.resize(1);
    out.equal_parts = true;
  }
  return out;
}

ValueTree structure(const Type& type, const ast::Initial* initial) {
  ValueTree out;
  bool all_zero = true;
  for (const Field& field : type.fields) {
    const ast::Initial* given = field.initial;
    if (initial != nullptr) {
      for (const ast::InitialElement& one : initial->elements) {
        given = same_name(one.field, field.name) ? &one.value : given;
      }
    }
    out.parts.push_back(initial_value(*field.type, given));
    all_zero = all_zero && out.parts.back().zero;
  }
  return all_zero ? zero() : out;
}

}  // namespace

std::uint64_t elements_of(const Type& array) noexcept {
  std::uint64_t count = 1;
  for (const Bounds& one : array.dimensions) {
    count *= one.count();
  }
  return count;
}

std::vector<const ast::Initial*> initial_elements(const ast::Initial& list, std::uint64_t most) {
  std::vector<const ast::Initial*> out;
  for (const ast::InitialElement& one : list.elements) {
    const Constant* count = one.count ? constant_of(*one.count) : nullptr;
    const auto repeat = count != nullptr ? static_cast<std::uint64_t>(as_int64(*count).value_or(1)) : 1;
    out.insert(out.end(), std::min(repeat, most - std::min<std::uint64_t>(most, out.size())), &one.value);
  }
  return out;
}

ValueTree initial_value(const Type& type, const ast::Initial* initial) {
  initial = initial != nullptr ? initial : type.initial;
  switch (type.kind) {
    case Type::Kind::Elementary: {
      const Constant* known = initial != nullptr && initial->value ? constant_of(*initial->value) : nullptr;
      if (known != nullptr) {
        return leaf(type.is_text() ? *known : stored(*known, type));
      }
      const bool outside = type.range && (type.range->low > 0 || type.range->high < 0);
      return outside ? leaf(Integer{type.range->low}) : zero();
    }
    case Type::Kind::Enum: {
      const Constant* known = initial != nullptr && initial->value ? constant_of(*initial->value) : nullptr;
      return leaf(known != nullptr ? *known : Constant(Integer{type.items.front().value}));
    }
    case Type::Kind::Struct:
      return type.overlaps ? zero()
                           : structure(type, initial != nullptr && initial->kind == Kind::Struct ? initial : nullptr);
    case Type::Kind::Array: {
      const std::uint64_t count = elements_of(type);
      std::size_t next = 0;
      const bool given = initial != nullptr && initial->kind == Kind::Array;
      return rows(type, 0, given ? initial_elements(*initial, count) : std::vector<const ast::Initial*>(), next);
    }
    case Type::Kind::Block:
    case Type::Kind::Pointer:
    case Type::Kind::Interface:
      return zero();
  }
  return zero();
}

}  // namespace indurop::plc
