// SPDX-License-Identifier: Apache-2.0
// GT GE EQ LE LT NE. With more than two operands each is compared with its neighbour: GT(a, b, c) is a > b and b > c.
// Texts of different lengths compare by their characters. A comparison with NaN is false, NE true. Real-time safe.

#pragma once

#include <indurop/plc/types.h>

#include <functional>
#include <string_view>

namespace indurop::iec {

namespace detail {
template <class T>
constexpr decltype(auto) comparable(const T& value) noexcept {
  if constexpr (Text<T>) {
    return value.view();
  } else {
    return (value);
  }
}

template <class Compare, class A, class B, class... More>
constexpr bool chain(Compare compare, const A& a, const B& b, const More&... more) noexcept {
  static_assert(SameKind<A, B>, "compared operands must have one type");
  if (!compare(comparable(a), comparable(b))) {
    return false;
  }
  if constexpr (sizeof...(More) > 0) {
    return chain(compare, b, more...);
  } else {
    return true;
  }
}
}  // namespace detail

template <class... T>
constexpr bool gt(const T&... in) noexcept {
  return detail::chain(std::greater<>(), in...);
}
template <class... T>
constexpr bool ge(const T&... in) noexcept {
  return detail::chain(std::greater_equal<>(), in...);
}
template <class... T>
constexpr bool eq(const T&... in) noexcept {
  return detail::chain(std::equal_to<>(), in...);
}
template <class... T>
constexpr bool le(const T&... in) noexcept {
  return detail::chain(std::less_equal<>(), in...);
}
template <class... T>
constexpr bool lt(const T&... in) noexcept {
  return detail::chain(std::less<>(), in...);
}
template <class A, class B>
constexpr bool ne(const A& a, const B& b) noexcept {
  return detail::chain(std::not_equal_to<>(), a, b);
}

}  // namespace indurop::iec
