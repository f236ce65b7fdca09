// SPDX-License-Identifier: Apache-2.0
// ADD SUB MUL DIV MOD, ABS, MOVE on numbers. Integers wrap around as two's complement; nothing overflows into undefined
// behaviour. A zero divisor is a fault with its place, for REAL too. Real-time safe.

#pragma once

#include <indurop/plc/fault.h>
#include <indurop/plc/types.h>

#include <type_traits>

namespace indurop::iec {

namespace detail {
// An unsigned type not narrower than int: its operands are not promoted to a type that can overflow.
template <Integer T>
using Modular = std::common_type_t<std::make_unsigned_t<T>, unsigned>;
}  // namespace detail

template <Number T>
constexpr T add(T a, T b) noexcept {
  if constexpr (Real<T>) {
    return a + b;
  } else {
    return static_cast<T>(static_cast<detail::Modular<T>>(a) + static_cast<detail::Modular<T>>(b));
  }
}

template <Number T>
constexpr T sub(T a, T b) noexcept {
  if constexpr (Real<T>) {
    return a - b;
  } else {
    return static_cast<T>(static_cast<detail::Modular<T>>(a) - static_cast<detail::Modular<T>>(b));
  }
}

template <Number T>
constexpr T mul(T a, T b) noexcept {
  if constexpr (Real<T>) {
    return a * b;
  } else {
    return static_cast<T>(static_cast<detail::Modular<T>>(a) * static_cast<detail::Modular<T>>(b));
  }
}

template <Number T, std::same_as<T>... More>
requires(sizeof...(More) > 0) constexpr T add(T a, T b, More... more) noexcept {
  return add(add(a, b), more...);
}

template <Number T, std::same_as<T>... More>
requires(sizeof...(More) > 0) constexpr T mul(T a, T b, More... more) noexcept {
  return mul(mul(a, b), more...);
}

// The negation of the most negative integer is itself.
template <Number T>
constexpr T neg(T a) noexcept {
  if constexpr (Real<T>) {
    return -a;
  } else {
    return sub(T{}, a);
  }
}

// Integer division truncates toward zero. Faults if b is zero.
template <Number T>
constexpr T div(Place place, T a, T b) {
  if (b == T{}) [[unlikely]] {
    fail(place, "division by zero");
  }
  if constexpr (std::signed_integral<T>) {
    if (b == T{-1}) {
      return neg(a);  // the most negative number has no positive one: wraps
    }
  }
  return static_cast<T>(a / b);
}

// Division as in IEEE 754: infinite or NaN if b is zero.
template <Real T>
constexpr T quotient(T a, T b) noexcept {
  return a / b;
}

// The remainder of div(), with the sign of a. Faults if b is zero.
template <Integer T>
constexpr T mod(Place place, T a, T b) {
  if (b == T{}) [[unlikely]] {
    fail(place, "MOD by zero");
  }
  if constexpr (std::signed_integral<T>) {
    if (b == T{-1}) {
      return T{};
    }
  }
  return static_cast<T>(a % b);
}

// The most negative integer is returned unchanged.
template <Number T>
constexpr T abs(T a) noexcept {
  if constexpr (Real<T>) {
    return a < T{} ? -a : a + T{};  // -0.0 + 0.0 is 0.0
  } else if constexpr (std::signed_integral<T>) {
    return a < T{} ? neg(a) : a;
  } else {
    return a;
  }
}

template <class T>
constexpr T move(const T& value) noexcept {
  return value;
}

}  // namespace indurop::iec
