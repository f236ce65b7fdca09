// SPDX-License-Identifier: Apache-2.0
// Numbers, bools and enumerators of shared variables in the types of the standard, and back.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/schema/leaf.h"
#include "core/schema/schema.h"

namespace indurop::fmi {

using Bytes = std::array<std::uint8_t, 8>;  // of a number, from the first one on

// Returns the value as `To`, or nothing if that type cannot hold it. A double becomes the nearest float.
template <class To, class From>
std::optional<To> exactly(From value) {
  if constexpr (std::is_same_v<To, From>) {
    return value;
  } else if constexpr (std::is_floating_point_v<To>) {
    const auto rounded = static_cast<To>(value);
    return std::is_floating_point_v<From> && std::isfinite(static_cast<double>(value)) && !std::isfinite(rounded)
               ? std::nullopt
               : std::optional<To>(rounded);
  } else if constexpr (std::is_floating_point_v<From>) {
    // The power of two after the largest number is exact in every floating-point type.
    const From beyond = std::ldexp(From{1}, std::numeric_limits<To>::digits);
    const From least = std::is_signed_v<To> ? -beyond : From{0};
    return value >= least && value < beyond && std::trunc(value) == value ? std::optional<To>(static_cast<To>(value))
                                                                          : std::nullopt;
  } else {
    return std::in_range<To>(value) ? std::optional<To>(static_cast<To>(value)) : std::nullopt;
  }
}

template <class To, class From>
std::optional<Bytes> stored(From value) {
  const std::optional<To> number = exactly<To>(value);
  if (!number) {
    return std::nullopt;
  }
  Bytes bytes{};
  std::memcpy(bytes.data(), &*number, sizeof(To));
  return bytes;
}

// Returns the bytes of a number in a variable of this type, or nothing if it cannot hold the value. `T` is a number.
template <class T>
std::optional<Bytes> to_bytes(schema::Base base, T value) {
  if constexpr (std::is_same_v<T, bool>) {
    return to_bytes<int>(base, value ? 1 : 0);
  } else {
    switch (base) {
      case schema::Base::Bool:
        return stored<std::uint8_t>(value != T{} ? 1 : 0);
      case schema::Base::Char:
      case schema::Base::UInt8:
        return stored<std::uint8_t>(value);
      case schema::Base::Int8:
        return stored<std::int8_t>(value);
      case schema::Base::Int16:
        return stored<std::int16_t>(value);
      case schema::Base::UInt16:
        return stored<std::uint16_t>(value);
      case schema::Base::Int32:
      case schema::Base::Enum:
        return stored<std::int32_t>(value);
      case schema::Base::UInt32:
        return stored<std::uint32_t>(value);
      case schema::Base::Int64:
        return stored<std::int64_t>(value);
      case schema::Base::UInt64:
        return stored<std::uint64_t>(value);
      case schema::Base::Float:
        return stored<float>(value);
      case schema::Base::Double:
        return stored<double>(value);
      case schema::Base::Text:
      case schema::Base::Struct:
        break;
    }
    return std::nullopt;
  }
}

// Returns the number as T; 0 for text and structs, which are none.
template <class T>
T from_bytes(schema::Base base, const Bytes& bytes) {
  return schema::as_number<T>(base, bytes.data()).value_or(T{});
}

}  // namespace indurop::fmi
