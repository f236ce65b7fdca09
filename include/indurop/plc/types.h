// SPDX-License-Identifier: Apache-2.0
// The elementary types of IEC 61131-3 in C++, and the groups of them that the standard functions accept.
//
//   BOOL bool    BYTE WORD DWORD LWORD and USINT UINT UDINT ULINT   std::uint8_t ... std::uint64_t
//   REAL float   LREAL double    SINT INT DINT LINT                 std::int8_t ... std::int64_t
//   STRING[n] String<n>   WSTRING[n] WString<n>   CHAR char8_t   WCHAR char16_t
//   TIME DATE TIME_OF_DAY DATE_AND_TIME and their L forms: the structs below
// All are trivially copyable.

#pragma once

#include <indurop/plc/wide_text.h>
#include <indurop/string.h>

#include <algorithm>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace indurop::iec {

// A duration, from -292 to 292 years.
struct Time {
  std::int64_t ns = 0;
  friend constexpr auto operator<=>(Time, Time) noexcept = default;  // NOLINT(modernize-use-nullptr)
};
// A day: nanoseconds from 1970-01-01 to its midnight. From 1677-09-22 to 2262-04-11.
struct Date {
  std::int64_t ns = 0;
  friend constexpr auto operator<=>(Date, Date) noexcept = default;  // NOLINT(modernize-use-nullptr)
};
// Nanoseconds since midnight, less than kDay.
struct TimeOfDay {
  std::int64_t ns = 0;
  friend constexpr auto operator<=>(TimeOfDay, TimeOfDay) noexcept = default;  // NOLINT(modernize-use-nullptr)
};
// Nanoseconds since 1970-01-01-00:00, without a time zone.
struct DateTime {
  std::int64_t ns = 0;
  friend constexpr auto operator<=>(DateTime, DateTime) noexcept = default;  // NOLINT(modernize-use-nullptr)
};

inline constexpr std::int64_t kMicrosecond = 1'000;
inline constexpr std::int64_t kMillisecond = 1'000'000;
inline constexpr std::int64_t kSecond = 1'000'000'000;
inline constexpr std::int64_t kMinute = 60 * kSecond;
inline constexpr std::int64_t kHour = 60 * kMinute;
inline constexpr std::int64_t kDay = 24 * kHour;

// STRING[n]: up to n characters, the same type as `char name[n + 1]` of a .glb file. A NUL ends the text.
template <std::size_t N>
using String = indurop::string<N + 1>;
// WSTRING[n]: up to n characters of two bytes.
template <std::size_t N>
using WString = WideText<N + 1>;

namespace detail {
template <class T>
struct TextTraits {
  static constexpr std::size_t kSize = 0;
  using Letter = void;
};
template <std::size_t N>
struct TextTraits<indurop::string<N>> {
  static constexpr std::size_t kSize = N;
  using Letter = char;
  template <std::size_t M>
  using Sized = indurop::string<M>;
};
template <std::size_t N>
struct TextTraits<WideText<N>> {
  static constexpr std::size_t kSize = N;
  using Letter = char16_t;
  template <std::size_t M>
  using Sized = WideText<M>;
};
// Size of a text including its terminating NUL.
template <class T>
inline constexpr std::size_t kTextSize = TextTraits<T>::kSize;
// A text type of the same kind as T with space for M - 1 characters.
template <class T, std::size_t M>
using Sized = typename TextTraits<T>::template Sized<M>;
}  // namespace detail

template <class T>
concept Text = detail::kTextSize<T> >
0;
// Texts of one kind: both STRING, or both WSTRING.
template <class A, class B>
concept SameLetters = Text<A> && Text<B> && std::same_as < typename detail::TextTraits<A>::Letter,
typename detail::TextTraits<B>::Letter > ;
template <class T>
concept NarrowText = SameLetters<T, String<1>>;
template <class T>
concept BroadText = SameLetters<T, WString<1>>;
template <class T>
concept Integer = std::integral<T> && !std::same_as<T, bool>;
template <class T>
concept Real = std::floating_point<T>;
template <class T>
concept Number = Integer<T> || Real<T>;
template <class T>
concept BitString = std::unsigned_integral<T>;  // bool too
template <class T>
concept Timelike =
    std::same_as<T, Time> || std::same_as<T, Date> || std::same_as<T, TimeOfDay> || std::same_as<T, DateTime>;

// Operands of one operation: the same type, or texts of any lengths.
template <class A, class B>
concept SameKind = std::same_as<A, B> || SameLetters<A, B>;

namespace detail {
template <class First, class... More>
constexpr auto common_type() noexcept {
  if constexpr (Text<First> && (... && SameLetters<First, More>)) {
    return std::type_identity<Sized<First, std::max({kTextSize<First>, kTextSize<More>...})>>();
  } else {
    static_assert((std::same_as<First, More> && ...), "all operands must have one type");
    return std::type_identity<First>();
  }
}
}  // namespace detail

// The type that can hold all of them: their common type, or the longest text.
template <class... T>
using Common = typename decltype(detail::common_type<T...>())::type;

}  // namespace indurop::iec
