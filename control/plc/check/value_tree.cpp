// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/value_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "control/plc/check/expression_checker.h"

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

// The values of a list with their repetitions, which are not expanded.
class Runs {
 public:
  explicit Runs(const ast::Initial* list) {
    if (list == nullptr) {
      return;
    }
    for (const ast::InitialElement& one : list->elements) {
      const Constant* count = one.count ? constant_of(*one.count) : nullptr;
      const std::int64_t repeat = count != nullptr ? as_int64(*count).value_or(1) : 1;
      if (repeat > 0) {
        runs_.emplace_back(&one.value, static_cast<std::uint64_t>(repeat));
      }
    }
  }

  [[nodiscard]] bool at_end() const noexcept { return next_ == runs_.size(); }
  [[nodiscard]] const ast::Initial* value() const noexcept { return at_end() ? nullptr : runs_[next_].first; }
  [[nodiscard]] std::uint64_t repeated() const noexcept { return at_end() ? 0 : runs_[next_].second; }
  // Requires that `count` is not more than the remaining repetitions of the first value.
  void take(std::uint64_t count) noexcept {
    if (!at_end() && (runs_[next_].second -= count) == 0) {
      ++next_;
    }
  }

 private:
  std::vector<std::pair<const ast::Initial*, std::uint64_t>> runs_;
  std::size_t next_ = 0;
};

// Returns the number of elements of the dimensions from `level` on.
std::uint64_t elements_from(const Type& array, std::size_t level) noexcept {
  std::uint64_t count = 1;
  for (; level < array.dimensions.size(); ++level) {
    count *= array.dimensions[level].count();
  }
  return count;
}

// Makes the elements of the dimensions from `level` on if all are equal.
ValueTree equal_rows(const Type& array, std::size_t level, const ast::Initial* value) {
  if (level == array.dimensions.size()) {
    return initial_value(*array.element, value);
  }
  ValueTree out;
  out.parts.push_back(equal_rows(array, level + 1, value));
  out.equal_parts = true;
  return out.parts[0].zero ? zero() : out;
}

// Consumes the elements of the dimensions from `level` on. Zeros at the end are left out.
ValueTree rows(const Type& array, std::size_t level, Runs& list) {
  const std::uint64_t all = elements_from(array, level);
  if (list.at_end() || list.repeated() >= all) {
    ValueTree out = equal_rows(array, level, list.value());
    list.take(all);
    return out;
  }
  ValueTree out;
  bool all_zero = true;
  const std::uint64_t count = array.dimensions[level].count();
  for (std::uint64_t i = 0; i < count; ++i) {
    const bool defaults = list.at_end();
    ValueTree part = rows(array, level + 1, list);
    if (defaults && part.zero) {
      break;
    }
    all_zero = all_zero && part.zero;
    out.parts.push_back(std::move(part));
  }
  return all_zero ? zero() : out;
}

// Returns the given values, or those of the declaration of the field; null: those of its type.
std::vector<const ast::Initial*> values_of_fields(const Type& type, const ast::Initial* initial) {
  std::vector<const ast::Initial*> out;
  for (const Field& field : type.fields) {
    out.push_back(field.initial);
  }
  if (initial != nullptr && initial->kind == Kind::Struct) {
    for (const ast::InitialElement& one : initial->elements) {
      if (const auto found = type.field_names.find(upper(one.field)); found != type.field_names.end()) {
        out[found->second] = &one.value;
      }
    }
  }
  return out;
}

ValueTree structure(const Type& type, const ast::Initial* initial) {
  ValueTree out;
  bool all_zero = true;
  for (const ast::Initial* given : values_of_fields(type, initial)) {
    out.parts.push_back(initial_value(*type.fields[out.parts.size()].type, given));
    all_zero = all_zero && out.parts.back().zero;
  }
  return all_zero ? zero() : out;
}

std::uint64_t saturating(std::uint64_t sum, std::uint64_t count, std::uint64_t each) noexcept {
  std::uint64_t product = 0;
  const bool over = __builtin_mul_overflow(count, each, &product) || __builtin_add_overflow(sum, product, &sum);
  return over ? std::numeric_limits<std::uint64_t>::max() : sum;
}

std::uint64_t values_of_array(const Type& type, const ast::Initial* initial) {
  const std::uint64_t all = elements_of(type);
  Runs list(initial);
  if (list.at_end() || list.repeated() >= all) {
    return values_of(*type.element, list.value());
  }
  std::uint64_t sum = 0;
  std::uint64_t left = all;
  constexpr std::uint64_t kEnough = std::uint64_t{1} << 24U;  // to be too many
  for (; !list.at_end() && left > 0 && sum < kEnough; list.take(list.repeated())) {
    const std::uint64_t count = std::min(left, list.repeated());
    left -= count;
    sum = saturating(sum, count, std::max<std::uint64_t>(1, values_of(*type.element, list.value())));
  }
  return saturating(sum, left, values_of(*type.element, nullptr));
}

// Computes the number of a type's own values, which do not change afterwards.
std::uint64_t computed_values_of(const Type& type, const ast::Initial* initial) {
  switch (type.kind) {
    case Type::Kind::Elementary:
    case Type::Kind::Enum:
      return initial_value(type, initial).zero ? 0 : 1;
    case Type::Kind::Array:
      return values_of_array(type, initial != nullptr && initial->kind == Kind::Array ? initial : nullptr);
    case Type::Kind::Struct: {
      std::uint64_t sum = 0;
      std::size_t i = 0;
      for (const ast::Initial* given : values_of_fields(type, type.overlaps ? nullptr : initial)) {
        sum = saturating(sum, 1, values_of(*type.fields[i++].type, given));
      }
      return type.overlaps || sum == 0 ? 0 : saturating(sum, 1, type.fields.size());
    }
    case Type::Kind::Block:
    case Type::Kind::Pointer:
    case Type::Kind::Interface:
      break;
  }
  return 0;
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

std::uint64_t values_of(const Type& type, const ast::Initial* initial) {
  if (initial != nullptr) {
    return computed_values_of(type, initial);
  }
  if (!type.default_values) {
    type.default_values = computed_values_of(type, type.initial);
  }
  return *type.default_values;
}

ValueTree initial_value(const Type& type, const ast::Initial* initial) {
  const bool is_large = type.kind == Type::Kind::Struct || type.kind == Type::Kind::Array;
  if (initial == nullptr && is_large && values_of(type, nullptr) == 0) {
    return zero();
  }
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
      return type.overlaps ? zero() : structure(type, initial);
    case Type::Kind::Array: {
      Runs list(initial != nullptr && initial->kind == Kind::Array ? initial : nullptr);
      return rows(type, 0, list);
    }
    case Type::Kind::Block:
    case Type::Kind::Pointer:
    case Type::Kind::Interface:
      return zero();
  }
  return zero();
}

}  // namespace indurop::plc
