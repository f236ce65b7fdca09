// SPDX-License-Identifier: Apache-2.0
// Access to numbers in the bytes of a value.

#pragma once

#include <cstdint>
#include <cstring>
#include <optional>

#include "core/schema/schema.h"

namespace indurop::schema {

template <class T>
T load(const std::uint8_t* at) noexcept {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

// Calls `use` with the number at `at` in its own C++ type. Returns false, without a call, for types that are not
// numbers.
template <class Use>
bool with_number(Base base, const std::uint8_t* at, Use use) {
  switch (base) {
    case Base::Int8:
      use(load<std::int8_t>(at));
      return true;
    case Base::UInt8:
      use(load<std::uint8_t>(at));
      return true;
    case Base::Int16:
      use(load<std::int16_t>(at));
      return true;
    case Base::UInt16:
      use(load<std::uint16_t>(at));
      return true;
    case Base::Int32:
      use(load<std::int32_t>(at));
      return true;
    case Base::UInt32:
      use(load<std::uint32_t>(at));
      return true;
    case Base::Int64:
      use(load<std::int64_t>(at));
      return true;
    case Base::UInt64:
      use(load<std::uint64_t>(at));
      return true;
    case Base::Float:
      use(load<float>(at));
      return true;
    case Base::Double:
      use(load<double>(at));
      return true;
    case Base::Bool:
    case Base::Char:
    case Base::Text:
    case Base::Enum:
    case Base::Struct:
      break;
  }
  return false;
}

// Returns the number at `at`, also that of an enumerator or a character; true is 1. Returns nothing for text and
// structs.
template <class T>
std::optional<T> as_number(Base base, const std::uint8_t* at) noexcept {
  if (base == Base::Bool) {
    return *at != 0 ? T{1} : T{0};
  }
  const Base stored = base == Base::Char ? Base::UInt8 : base == Base::Enum ? Base::Int32 : base;
  std::optional<T> number;
  with_number(stored, at, [&number](auto value) { number = static_cast<T>(value); });
  return number;
}

// Returns the distance in bytes between neighbours of dimension `dim` (0 is the outermost).
inline std::uint64_t stride_of(const Type& type, std::size_t dim) noexcept {
  std::uint64_t stride = type.element_size;
  for (std::size_t i = dim + 1; i < type.dims.size(); ++i) {
    stride *= type.dims[i];
  }
  return stride;
}

}  // namespace indurop::schema
