// SPDX-License-Identifier: Apache-2.0
#include "control/io/scaling.h"

#include <cstring>

#include "control/io/number.h"
#include "core/schema/leaf.h"

namespace indurop::io {
namespace {

using schema::Base;

template <class T>
void put(T value, std::uint64_t& bits) noexcept {
  bits = 0;
  std::memcpy(&bits, &value, sizeof value);
}

template <class T>
T get(std::uint64_t bits) noexcept {
  T value{};
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

template <class T>
bool put_whole(Number value, std::uint64_t& bits) noexcept {
  T whole = get<T>(bits);
  const bool fits = to_whole(value, whole);
  put(whole, bits);
  return fits;
}

template <class T>
bool put_real(Number value, std::uint64_t& bits) noexcept {
  T real = 0;
  const bool fits = to_real(value, real);
  put(real, bits);
  return fits;
}

}  // namespace

bool to_variable(Base base, Number value, std::uint64_t& bits) noexcept {
  switch (base) {
    case Base::Bool:
      put<std::uint8_t>(value != 0 ? 1 : 0, bits);
      return true;
    case Base::Char:
    case Base::UInt8:
      return put_whole<std::uint8_t>(value, bits);
    case Base::Int8:
      return put_whole<std::int8_t>(value, bits);
    case Base::Int16:
      return put_whole<std::int16_t>(value, bits);
    case Base::UInt16:
      return put_whole<std::uint16_t>(value, bits);
    case Base::Enum:
    case Base::Int32:
      return put_whole<std::int32_t>(value, bits);
    case Base::UInt32:
      return put_whole<std::uint32_t>(value, bits);
    case Base::Int64:
      return put_whole<std::int64_t>(value, bits);
    case Base::UInt64:
      return put_whole<std::uint64_t>(value, bits);
    case Base::Float:
      return put_real<float>(value, bits);
    case Base::Double:
      return put_real<double>(value, bits);
    case Base::Text:
    case Base::Struct:
      break;
  }
  return false;
}

bool to_variable(const Scaling& scaling, Number value, std::uint64_t& bits) noexcept {
  return to_variable(scaling.base, value * static_cast<Number>(scaling.scale) + static_cast<Number>(scaling.offset),
                     bits);
}

Number from_variable(const Scaling& scaling, std::uint64_t bits) noexcept {
  const auto value = schema::as_number<Number>(scaling.base, reinterpret_cast<const std::uint8_t*>(&bits)).value_or(0);
  return (value - static_cast<Number>(scaling.offset)) / static_cast<Number>(scaling.scale);
}

}  // namespace indurop::io
