// SPDX-License-Identifier: Apache-2.0
// Arithmetic of times and dates: ADD SUB MUL DIV on them, CONCAT_DATE_TOD and similar functions. The time of day wraps
// around at midnight; everything else wraps like 64-bit integers. Real-time safe.

#pragma once

#include <indurop/plc/convert.h>
#include <indurop/plc/fault.h>
#include <indurop/plc/types.h>

#include <cmath>
#include <utility>

namespace indurop::iec {

constexpr Time neg(Time a) noexcept {
  return {neg(a.ns)};
}
constexpr Time add(Time a, Time b) noexcept {
  return {add(a.ns, b.ns)};
}
constexpr Time sub(Time a, Time b) noexcept {
  return {sub(a.ns, b.ns)};
}
constexpr TimeOfDay add(TimeOfDay a, Time b) noexcept {
  return detail::normalized<TimeOfDay>(add(a.ns, b.ns % kDay));
}
constexpr TimeOfDay sub(TimeOfDay a, Time b) noexcept {
  return detail::normalized<TimeOfDay>(sub(a.ns, b.ns % kDay));
}
constexpr DateTime add(DateTime a, Time b) noexcept {
  return {add(a.ns, b.ns)};
}
constexpr DateTime sub(DateTime a, Time b) noexcept {
  return {sub(a.ns, b.ns)};
}
constexpr Time sub(Date a, Date b) noexcept {
  return {sub(a.ns, b.ns)};
}
constexpr Time sub(TimeOfDay a, TimeOfDay b) noexcept {
  return {sub(a.ns, b.ns)};
}
constexpr Time sub(DateTime a, DateTime b) noexcept {
  return {sub(a.ns, b.ns)};
}

// With a REAL factor: rounds to the nearest nanosecond and saturates at the range of TIME.
template <Number N>
constexpr Time mul(Time a, N factor) noexcept {
  if constexpr (Real<N>) {
    return {detail::saturated<std::int64_t>(std::nearbyint(static_cast<double>(a.ns) * static_cast<double>(factor)))};
  } else {
    return {mul(a.ns, static_cast<std::int64_t>(factor))};
  }
}

// With an integer divisor: truncates toward zero. Faults if the divisor is zero.
template <Number N>
constexpr Time div(Place place, Time a, N divisor) {
  if (divisor == N{}) [[unlikely]] {
    fail(place, "division by zero");
  }
  if constexpr (Real<N>) {
    return {detail::saturated<std::int64_t>(std::nearbyint(static_cast<double>(a.ns) / static_cast<double>(divisor)))};
  } else if constexpr (std::same_as<N, std::uint64_t>) {
    const std::uint64_t size = a.ns < 0 ? 0U - static_cast<std::uint64_t>(a.ns) : static_cast<std::uint64_t>(a.ns);
    const auto quotient = static_cast<std::int64_t>(size / divisor);
    return {a.ns < 0 ? neg(quotient) : quotient};
  } else {
    return {div(place, a.ns, static_cast<std::int64_t>(divisor))};
  }
}

constexpr DateTime concat_date_tod(Date date, TimeOfDay time) noexcept {
  return {add(date.ns, time.ns)};
}

namespace detail {

inline constexpr std::int64_t kDaysBefore1970 = 719'468;  // since 0000-03-01
inline constexpr std::int64_t kDaysOf400Years = 146'097;

// Days from 1970-01-01 to the date, in the Gregorian calendar. Years are counted from March, so that the leap day is
// the last day of a year, and in cycles of 400. Months and days beyond their range carry over into the next ones.
// Requires |year| < 10^6.
constexpr std::int64_t days_of(std::int64_t year, std::int64_t month, std::int64_t day) noexcept {
  const std::int64_t months = year * 12 + month - 3;
  const std::int64_t from_march = floor_div(months, 12);
  const std::int64_t cycle = floor_div(from_march, 400);
  const std::int64_t of_cycle = from_march - cycle * 400;
  const std::int64_t before_month = (153 * (months - from_march * 12) + 2) / 5;
  return cycle * kDaysOf400Years + of_cycle * 365 + of_cycle / 4 - of_cycle / 100 + before_month + day - 1 -
         kDaysBefore1970;
}

struct Civil {
  std::int64_t year;
  int month;
  int day;
};
constexpr Civil civil_of(std::int64_t days) noexcept {
  const std::int64_t shifted = days + kDaysBefore1970;
  const std::int64_t cycle = floor_div(shifted, kDaysOf400Years);
  const std::int64_t of_cycle = shifted - cycle * kDaysOf400Years;
  const std::int64_t year = (of_cycle - of_cycle / 1460 + of_cycle / 36524 - of_cycle / 146096) / 365;
  const std::int64_t of_year = of_cycle - (365 * year + year / 4 - year / 100);
  const std::int64_t month = (5 * of_year + 2) / 153;
  const auto day = static_cast<int>(of_year - (153 * month + 2) / 5 + 1);
  const bool next_year = month >= 10;
  return {year + cycle * 400 + (next_year ? 1 : 0), static_cast<int>(next_year ? month - 9 : month + 3), day};
}

template <Integer T>
constexpr std::int64_t bounded(T value) noexcept {
  constexpr std::int64_t kBound = 999'999;
  if (std::cmp_greater(value, kBound)) {
    return kBound;
  }
  return std::cmp_less(value, -kBound) ? -kBound : static_cast<std::int64_t>(value);
}

}  // namespace detail

// The 31st of April is the 1st of May; saturates at the range of DATE.
template <Integer Y, Integer M, Integer D>
constexpr Date concat_date(Y year, M month, D day) noexcept {
  return detail::day(detail::days_of(detail::bounded(year), detail::bounded(month), detail::bounded(day)));
}

template <Integer H, Integer M, Integer S, Integer F>
constexpr TimeOfDay concat_tod(H hour, M minute, S second, F millisecond) noexcept {
  return detail::normalized<TimeOfDay>(detail::bounded(hour) * kHour + detail::bounded(minute) * kMinute +
                                       detail::bounded(second) * kSecond + detail::bounded(millisecond) * kMillisecond);
}

template <Integer Y, Integer M, Integer D, Integer H, Integer N, Integer S, Integer F>
constexpr DateTime concat_dt(Y year, M month, D day, H hour, N minute, S second, F millisecond) noexcept {
  return concat_date_tod(concat_date(year, month, day), concat_tod(hour, minute, second, millisecond));
}

// 0 is Sunday.
constexpr std::int16_t day_of_week(Date date) noexcept {
  constexpr std::int64_t kThursday = 4;  // 1970-01-01
  return static_cast<std::int16_t>(detail::floor_mod(detail::floor_div(date.ns, kDay) + kThursday, 7));
}

}  // namespace indurop::iec
