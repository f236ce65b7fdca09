// SPDX-License-Identifier: Apache-2.0
// Conversions X_TO_Y between numbers, bit strings, BOOL and times, TRUNC, and binary coded decimals. Real-time safe.
//
//   integer to integer   the low bits stay, as in the arithmetic
//   REAL to integer      to the nearest, halves to the even one; beyond the range its nearest end; NaN is 0
//   to BOOL              anything but 0 is TRUE
//   TIME, TIME_OF_DAY    are milliseconds as numbers; DATE, DATE_AND_TIME seconds since 1970-01-01
// Texts: text_convert.h.

#pragma once

#include <indurop/plc/arithmetic.h>
#include <indurop/plc/types.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace indurop::iec {

namespace detail {

// Returns `x` without its fraction as an integer; NaN is 0; saturates at the range of the type.
template <Integer T>
constexpr T saturated(double x) noexcept {
  constexpr auto kLow = static_cast<double>(std::numeric_limits<T>::min());
  constexpr double kEnd = 2.0 * static_cast<double>(T{1} << (std::numeric_limits<T>::digits - 1));
  if (x >= kEnd) {
    return std::numeric_limits<T>::max();
  }
  if (x <= kLow) {
    return std::numeric_limits<T>::min();
  }
  return x == x ? static_cast<T>(x) : T{};
}

// The value of one unit of the number, in ns.
template <Timelike T>
inline constexpr std::int64_t kUnit = std::same_as<T, Time> || std::same_as<T, TimeOfDay> ? kMillisecond : kSecond;

// Division that rounds down, also below zero, and its remainder, which is never negative.
constexpr std::int64_t floor_div(std::int64_t a, std::int64_t by) noexcept {
  return a / by - (a % by < 0 ? 1 : 0);
}
constexpr std::int64_t floor_mod(std::int64_t a, std::int64_t by) noexcept {
  const std::int64_t rest = a % by;
  return rest < 0 ? rest + by : rest;
}

// The date `days` days after 1970-01-01; saturates at the range of Date.
constexpr Date day(std::int64_t days) noexcept {
  constexpr std::int64_t kMaxDays = std::numeric_limits<std::int64_t>::max() / kDay;
  return {std::clamp(days, -kMaxDays, kMaxDays) * kDay};
}

// A Date is rounded down to midnight, a TimeOfDay wraps around there.
template <Timelike T>
constexpr T normalized(std::int64_t ns) noexcept {
  if constexpr (std::same_as<T, Date>) {
    return day(floor_div(ns, kDay));
  } else if constexpr (std::same_as<T, TimeOfDay>) {
    return {floor_mod(ns, kDay)};
  } else {
    return {ns};
  }
}

template <Timelike T, class From>
T time_of(From value) noexcept {
  if constexpr (Timelike<From>) {
    return normalized<T>(value.ns);
  } else if constexpr (Real<From>) {
    return normalized<T>(
        saturated<std::int64_t>(std::nearbyint(static_cast<double>(value) * static_cast<double>(kUnit<T>))));
  } else {
    return normalized<T>(mul(static_cast<std::int64_t>(value), kUnit<T>));
  }
}

}  // namespace detail

template <class T>
concept Scalar = std::is_arithmetic_v<T> || Timelike<T>;

// X_TO_Y is to<Y>(x).
template <Scalar To, Scalar From>
To to(From value) noexcept {
  if constexpr (std::same_as<To, From>) {
    return value;
  } else if constexpr (Timelike<To>) {
    return detail::time_of<To>(value);
  } else if constexpr (std::same_as<To, bool>) {
    if constexpr (Timelike<From>) {
      return value.ns != 0;
    } else {
      return value != From{};
    }
  } else if constexpr (Timelike<From>) {
    if constexpr (Real<To>) {
      return static_cast<To>(static_cast<double>(value.ns) / static_cast<double>(detail::kUnit<From>));
    } else {
      return static_cast<To>(value.ns / detail::kUnit<From>);
    }
  } else if constexpr (Real<From> && Integer<To>) {
    return detail::saturated<To>(std::nearbyint(static_cast<double>(value)));
  } else {
    return static_cast<To>(value);
  }
}

// Truncates toward zero; otherwise like to<To>(value).
template <Integer To, Real From>
To trunc(From value) noexcept {
  return detail::saturated<To>(std::trunc(static_cast<double>(value)));
}

// Decodes BCD: 16#1234 is 1234. A digit above 9 counts with its value: 16#1A is 20.
template <Integer To, BitString From>
constexpr To from_bcd(From value) noexcept {
  std::uint64_t result = 0;
  for (int shift = std::numeric_limits<From>::digits - 4; shift >= 0; shift -= 4) {
    result = result * 10 + ((std::uint64_t{value} >> shift) & 0xFU);
  }
  return static_cast<To>(result);
}

// Returns whether all BCD digits are valid, 0 to 9.
template <BitString From>
constexpr bool is_valid_bcd(From value) noexcept {
  std::uint64_t rest = value;
  bool valid = true;
  for (; rest != 0; rest >>= 4) {
    valid = valid && (rest & 0xFU) < 10;
  }
  return valid;
}

// Encodes BCD: 1234 is 16#1234. High digits that do not fit are lost: USINT_TO_BCD_BYTE(123) is 16#23.
template <BitString To, Integer From>
constexpr To to_bcd(From value) noexcept {
  std::uint64_t result = 0;
  auto rest = static_cast<std::uint64_t>(value);
  for (int shift = 0; shift < std::numeric_limits<To>::digits; shift += 4) {
    result |= (rest % 10) << shift;
    rest /= 10;
  }
  return static_cast<To>(result);
}

// BCD_TO_INT and INT_TO_BCD of the library Util: return -1 and 255 for a value that cannot be converted.
constexpr std::int16_t bcd_to_int(std::uint8_t value) noexcept {
  const bool fine = (value >> 4U) < 10U && (value & 0xFU) < 10U;
  return fine ? from_bcd<std::int16_t>(value) : std::int16_t{-1};
}
constexpr std::uint8_t int_to_bcd(std::int16_t value) noexcept {
  return value >= 0 && value < 100 ? to_bcd<std::uint8_t>(value) : std::uint8_t{255};
}

}  // namespace indurop::iec
