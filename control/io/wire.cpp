// SPDX-License-Identifier: Apache-2.0
#include "control/io/wire.h"

#include <bit>
#include <cmath>

#include "control/io/number.h"

namespace indurop::io {
namespace {

constexpr unsigned kWordBits = 16;

std::uint16_t swapped(std::uint16_t word) noexcept {
  constexpr unsigned kByteBits = 8;
  return static_cast<std::uint16_t>(static_cast<unsigned>(word) << kByteBits |
                                    static_cast<unsigned>(word) >> kByteBits);
}

std::uint64_t gather(const WireForm& form, std::span<const std::uint16_t> registers) noexcept {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < registers.size(); ++i) {
    const std::uint16_t word = registers[form.swap_words ? registers.size() - 1 - i : i];
    bits = bits << kWordBits | (form.swap_bytes ? swapped(word) : word);
  }
  return bits;
}

void scatter(const WireForm& form, std::uint64_t bits, std::span<std::uint16_t> registers) noexcept {
  for (std::size_t i = registers.size(); i > 0; --i, bits >>= kWordBits) {
    const auto word = static_cast<std::uint16_t>(bits);
    registers[form.swap_words ? registers.size() - i : i - 1] = form.swap_bytes ? swapped(word) : word;
  }
}

template <class T>
bool encode_whole(const WireForm& form, Number value, std::span<std::uint16_t> registers) noexcept {
  T whole = 0;
  const bool fits = to_whole(value, whole);
  if (!std::isnan(value)) {
    scatter(form, static_cast<std::uint64_t>(whole), registers);
  }
  return fits;
}

bool encode_float(const WireForm& form, Number value, std::span<std::uint16_t> registers) noexcept {
  float nearest = 0;
  const bool fits = to_real(value, nearest);
  scatter(form, std::bit_cast<std::uint32_t>(nearest), registers);
  return fits;
}

}  // namespace

Number decode(const WireForm& form, std::span<const std::uint16_t> registers) noexcept {
  const std::uint64_t bits = gather(form, registers);
  switch (form.type) {
    case WireType::Bool:
      return bits != 0 ? 1 : 0;
    case WireType::Int16:
      return static_cast<std::int16_t>(bits);
    case WireType::UInt16:
      return static_cast<std::uint16_t>(bits);
    case WireType::Int32:
      return static_cast<std::int32_t>(bits);
    case WireType::UInt32:
      return static_cast<std::uint32_t>(bits);
    case WireType::Int64:
      return static_cast<Number>(static_cast<std::int64_t>(bits));
    case WireType::UInt64:
      return static_cast<Number>(bits);
    case WireType::Float32:
      return static_cast<Number>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case WireType::Float64:
      return static_cast<Number>(std::bit_cast<double>(bits));
  }
  return 0;
}

Number value_in(const config::IoPoint& point, std::span<const std::uint16_t> registers) noexcept {
  return point.address.bit < 0
             ? decode(form_of(point), registers)
             : static_cast<Number>(static_cast<unsigned>(registers[0]) >> static_cast<unsigned>(point.address.bit) &
                                   1U);
}

bool encode(const WireForm& form, Number value, std::span<std::uint16_t> registers) noexcept {
  switch (form.type) {
    case WireType::Bool:
      scatter(form, value != 0 && !std::isnan(value) ? 1 : 0, registers);
      return !std::isnan(value);
    case WireType::Int16:
      return encode_whole<std::int16_t>(form, value, registers);
    case WireType::UInt16:
      return encode_whole<std::uint16_t>(form, value, registers);
    case WireType::Int32:
      return encode_whole<std::int32_t>(form, value, registers);
    case WireType::UInt32:
      return encode_whole<std::uint32_t>(form, value, registers);
    case WireType::Int64:
      return encode_whole<std::int64_t>(form, value, registers);
    case WireType::UInt64:
      return encode_whole<std::uint64_t>(form, value, registers);
    case WireType::Float32:
      return encode_float(form, value, registers);
    case WireType::Float64:
      scatter(form, std::bit_cast<std::uint64_t>(static_cast<double>(value)), registers);
      return true;
  }
  return false;
}

}  // namespace indurop::io
