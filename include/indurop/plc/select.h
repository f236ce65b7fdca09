// SPDX-License-Identifier: Apache-2.0
// SEL MAX MIN LIMIT MUX, and the checked index of arrays and subranges. Real-time safe.

#pragma once

#include <indurop/plc/bits.h>
#include <indurop/plc/compare.h>
#include <indurop/plc/fault.h>
#include <indurop/plc/types.h>

#include <cstddef>
#include <limits>
#include <utility>

namespace indurop::iec {

// Returns in0 if g is false, in1 if it is true.
template <class A, class B>
constexpr Common<A, B> sel(bool g, const A& in0, const B& in1) noexcept {
  return g ? Common<A, B>(in1) : Common<A, B>(in0);
}

// Returns the first of equal values. A NaN as first argument is kept, any other is ignored.
template <class First, class... More>
constexpr Common<First, More...> max(const First& first, const More&... more) noexcept {
  Common<First, More...> result(first);
  ((gt(more, result) ? static_cast<void>(result = Common<First, More...>(more)) : static_cast<void>(0)), ...);
  return result;
}

template <class First, class... More>
constexpr Common<First, More...> min(const First& first, const More&... more) noexcept {
  Common<First, More...> result(first);
  ((lt(more, result) ? static_cast<void>(result = Common<First, More...>(more)) : static_cast<void>(0)), ...);
  return result;
}

// MIN(MAX(IN, MN), MX): `mx` if the limits are swapped; NaN stays NaN.
template <class Low, class T, class High>
constexpr Common<Low, T, High> limit(const Low& mn, const T& in, const High& mx) noexcept {
  return min(max(in, mn), mx);
}

namespace detail {
template <Integer T>
constexpr std::int64_t shown(T value) noexcept {
  constexpr auto kMax = std::numeric_limits<std::int64_t>::max();
  return std::cmp_greater(value, kMax) ? kMax : static_cast<std::int64_t>(value);
}
}  // namespace detail

// Input number k, from 0. Faults if there is no such input.
template <Integer K, class First, class... More>
constexpr Common<First, More...> mux(Place place, K k, const First& first, const More&... more) {
  using Result = Common<First, More...>;
  if (std::cmp_less(k, 0) || std::cmp_greater(k, sizeof...(More))) [[unlikely]] {
    fail_range(place, "selector K of MUX", detail::shown(k), 0, sizeof...(More));
  }
  Result result(first);
  std::size_t number = 0;
  ((std::cmp_equal(k, ++number) ? static_cast<void>(result = Result(more)) : static_cast<void>(0)), ...);
  return result;
}

// The position, from 0, of element `value` of ARRAY [low..high]. Faults outside the bounds.
template <Integer T>
constexpr std::size_t index(Place place, T value, std::int64_t low, std::int64_t high) {
  if (std::cmp_less(value, low) || std::cmp_greater(value, high)) [[unlikely]] {
    fail_range(place, "index", detail::shown(value), low, high);
  }
  return static_cast<std::size_t>(value) - static_cast<std::size_t>(low);
}

// Returns `value`, for a variable of the subrange type (low..high). Faults outside the range.
template <Integer T>
constexpr T in_range(Place place, T value, std::int64_t low, std::int64_t high) {
  if (std::cmp_less(value, low) || std::cmp_greater(value, high)) [[unlikely]] {
    fail_range(place, "value", detail::shown(value), low, high);
  }
  return value;
}

// set_bit() for a variable of the subrange type (low..high). Faults, without a change, if the result is outside the
// range.
template <Integer T>
constexpr void set_bit_in_range(Place place, T& value, unsigned number, bool to, std::int64_t low, std::int64_t high) {
  T changed = value;
  set_bit(changed, number, to);
  value = in_range(place, changed, low, high);
}

}  // namespace indurop::iec
