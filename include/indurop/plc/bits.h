// SPDX-License-Identifier: Apache-2.0
// SHL SHR ROL ROR AND OR XOR NOT, and single bits (`w.3`). Real-time safe.

#pragma once

#include <indurop/plc/types.h>

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace indurop::iec {

namespace detail {
// Number of bits of the type; 1 for bool.
template <BitString T>
inline constexpr int kWidth = std::numeric_limits<T>::digits;
}  // namespace detail

// Shifts in zeros; returns 0 if n is the width or more, `in` unchanged if n is negative.
template <BitString T, Integer N>
constexpr T shl(T in, N n) noexcept {
  if (n <= N{}) {
    return in;
  }
  if (std::cmp_greater_equal(n, detail::kWidth<T>)) {
    return T{};
  }
  return static_cast<T>(std::uint64_t{in} << n);
}

template <BitString T, Integer N>
constexpr T shr(T in, N n) noexcept {
  if (n <= N{}) {
    return in;
  }
  if (std::cmp_greater_equal(n, detail::kWidth<T>)) {
    return T{};
  }
  return static_cast<T>(std::uint64_t{in} >> n);
}

// Accepts any n: multiples of the width change nothing, a negative n rotates the other way.
template <BitString T, Integer N>
constexpr T rol(T in, N n) noexcept {
  constexpr auto kWidth = static_cast<unsigned>(detail::kWidth<T>);
  const unsigned left = static_cast<unsigned>(n) % kWidth;  // widths are powers of two, so wrapped numbers work too
  if (left == 0) {
    return in;
  }
  return static_cast<T>((std::uint64_t{in} << left) | (std::uint64_t{in} >> (kWidth - left)));
}

template <BitString T, Integer N>
constexpr T ror(T in, N n) noexcept {
  return rol(in, 0U - static_cast<unsigned>(n));
}

// Integers, shifted and rotated as CODESYS does it: by their bits; a right shift extends the sign.
template <std::signed_integral T, Integer N>
constexpr T shl(T in, N n) noexcept {
  return static_cast<T>(shl(static_cast<std::make_unsigned_t<T>>(in), n));
}
template <std::signed_integral T, Integer N>
constexpr T shr(T in, N n) noexcept {
  constexpr int kMaxShift = std::numeric_limits<T>::digits;
  return n <= N{} ? in : static_cast<T>(in >> (std::cmp_greater(n, kMaxShift) ? kMaxShift : static_cast<int>(n)));
}
template <std::signed_integral T, Integer N>
constexpr T rol(T in, N n) noexcept {
  return static_cast<T>(rol(static_cast<std::make_unsigned_t<T>>(in), n));
}
template <std::signed_integral T, Integer N>
constexpr T ror(T in, N n) noexcept {
  return static_cast<T>(ror(static_cast<std::make_unsigned_t<T>>(in), n));
}

template <std::integral T, std::same_as<T>... More>
constexpr T bit_and(T a, More... more) noexcept {
  return static_cast<T>((a & ... & more));
}
template <std::integral T, std::same_as<T>... More>
constexpr T bit_or(T a, More... more) noexcept {
  return static_cast<T>((a | ... | more));
}
template <std::integral T, std::same_as<T>... More>
constexpr T bit_xor(T a, More... more) noexcept {
  return static_cast<T>((a ^ ... ^ more));
}
template <std::integral T>
constexpr T bit_not(T a) noexcept {
  if constexpr (std::same_as<T, bool>) {
    return !a;
  } else {
    return static_cast<T>(~a);
  }
}

// Bit `number` of a value, 0 the lowest. Requires number < width: the compiler of PLC programs has checked it.
template <Integer T>
constexpr bool bit(T value, unsigned number) noexcept {
  return ((std::uint64_t{static_cast<std::make_unsigned_t<T>>(value)} >> number) & 1U) != 0;
}
template <Integer T>
constexpr void set_bit(T& value, unsigned number, bool to) noexcept {
  const std::uint64_t mask = std::uint64_t{1} << number;
  const std::uint64_t old{static_cast<std::make_unsigned_t<T>>(value)};
  value = static_cast<T>(to ? old | mask : old & ~mask);
}

// The bits from `first` on, as many as P has: `w.%B1` is part<std::uint8_t>(w, 8). Requires that the value has them.
template <BitString P, BitString T>
constexpr P part(T value, unsigned first) noexcept {
  return static_cast<P>(std::uint64_t{value} >> first);
}
template <BitString P, BitString T>
constexpr void set_part(T& value, unsigned first, P to) noexcept {
  const std::uint64_t mask = std::uint64_t{std::numeric_limits<P>::max()} << first;
  value = static_cast<T>((std::uint64_t{value} & ~mask) | (std::uint64_t{to} << first));
}

namespace detail {
template <std::integral T>
constexpr T swapped(T in) noexcept {
  auto rest = static_cast<std::make_unsigned_t<T>>(in);
  std::make_unsigned_t<T> out = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    out = static_cast<std::make_unsigned_t<T>>((std::uint64_t{out} << 8U) | (rest & 0xFFU));
    rest = static_cast<std::make_unsigned_t<T>>(std::uint64_t{rest} >> 8U);
  }
  return static_cast<T>(out);
}

// Returns the value with its bytes in the order `to`; texts and single bytes are unchanged.
template <std::endian to, class T>
constexpr T ordered(const T& in) noexcept {
  if constexpr (to == std::endian::native || std::same_as<T, bool> || Text<T>) {
    return in;
  } else if constexpr (Timelike<T>) {
    return T{swapped(in.ns)};
  } else if constexpr (std::same_as<T, float>) {
    return std::bit_cast<float>(swapped(std::bit_cast<std::uint32_t>(in)));
  } else if constexpr (std::same_as<T, double>) {
    return std::bit_cast<double>(swapped(std::bit_cast<std::uint64_t>(in)));
  } else {
    return swapped(in);
  }
}
}  // namespace detail

// TO_BIG_ENDIAN and FROM_BIG_ENDIAN: converts the value to or from big-endian byte order.
template <class T>
constexpr T big_endian(const T& in) noexcept {
  return detail::ordered<std::endian::big>(in);
}
template <class T>
constexpr T little_endian(const T& in) noexcept {
  return detail::ordered<std::endian::little>(in);
}

}  // namespace indurop::iec
