// SPDX-License-Identifier: Apache-2.0
#include "core/schema/write_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/schema/leaf.h"

namespace indurop::schema {
namespace {

const Field* find_field(const Type& type, std::string_view name, std::span<const std::uint8_t> bytes) {
  const auto found =
      std::find_if(type.fields.begin(), type.fields.end(), [name](const Field& field) { return field.name == name; });
  const bool fits =
      found != type.fields.end() && found->offset <= bytes.size() && found->type.size() <= bytes.size() - found->offset;
  return type.dims.empty() && fits ? &*found : nullptr;
}

template <class T>
bool holds(double value) {
  if constexpr (std::is_integral_v<T>) {
    // 2^digits is exact in a double, the largest number of 64 bits is not.
    const double end = std::ldexp(1.0, std::numeric_limits<T>::digits);
    return value == std::trunc(value) && value >= (std::is_signed_v<T> ? -end : 0.0) && value < end;
  } else {
    return !std::isfinite(value) || std::abs(value) <= static_cast<double>(std::numeric_limits<T>::max());
  }
}

bool write_number(Base base, double value, std::uint8_t* at) {
  if (base == Base::Bool) {
    const bool truth = value == 1;
    *at = truth ? 1 : value == 0 ? 0 : *at;
    return truth || value == 0;
  }
  bool written = false;
  with_number(base == Base::Enum ? Base::Int32 : base, at, [&](auto old) {
    using T = decltype(old);
    if (holds<T>(value)) {
      const T number = static_cast<T>(value);
      std::memcpy(at, &number, sizeof number);
      written = true;
    }
  });
  return written;
}

}  // namespace

bool write_field(const Type& type, std::string_view field, double value, std::span<std::uint8_t> bytes) {
  const Field* const found = find_field(type, field, bytes);
  return found != nullptr && found->type.dims.empty() &&
         write_number(found->type.base, value, bytes.data() + found->offset);
}

bool write_field(const Type& type, std::string_view field, std::span<const double> values,
                 std::span<std::uint8_t> bytes) {
  const Field* const found = find_field(type, field, bytes);
  if (found == nullptr || found->type.dims.size() != 1 || found->type.dims[0] != values.size()) {
    return false;
  }
  std::vector<std::uint8_t> made(found->type.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!write_number(found->type.base, values[i], made.data() + i * found->type.element_size)) {
      return false;
    }
  }
  std::copy(made.begin(), made.end(), bytes.begin() + found->offset);
  return true;
}

bool write_field(const Type& type, std::string_view field, std::string_view text, std::span<std::uint8_t> bytes) {
  const Field* const found = find_field(type, field, bytes);
  if (found == nullptr || found->type.base != Base::Text || !found->type.dims.empty() ||
      text.size() >= found->type.text_size) {
    return false;
  }
  const auto at = bytes.begin() + found->offset;
  std::fill(std::copy(text.begin(), text.end(), at), at + static_cast<std::ptrdiff_t>(found->type.text_size),
            std::uint8_t{0});
  return true;
}

}  // namespace indurop::schema
