// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/time_literal.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <chrono>
#include <limits>

namespace indurop::plc::st {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kDay = 86'400 * kSecond;

struct Unit {
  std::string_view name;
  std::int64_t ns;
};
constexpr std::array<Unit, 7> kUnits{{{"D", kDay},
                                      {"H", 3600 * kSecond},
                                      {"M", 60 * kSecond},
                                      {"S", kSecond},
                                      {"MS", 1'000'000},
                                      {"US", 1'000},
                                      {"NS", 1}}};

TimeValue wrong_time(std::string why) {
  return {std::nullopt, std::move(why)};
}

// Consumes the digits (and '_') at the front; "" if there are none.
std::string take_digits(std::string_view& text) {
  std::string out;
  while (!text.empty() && ((text[0] >= '0' && text[0] <= '9') || (text[0] == '_' && !out.empty()))) {
    if (text[0] != '_') {
      out += text[0];
    }
    text.remove_prefix(1);
  }
  return out;
}

// Returns whole.fraction times `unit`; nullopt if it does not fit. Fractions of a nanosecond are cut off.
std::optional<std::int64_t> scaled(const std::string& whole, const std::string& fraction, std::int64_t unit) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(whole.data(), whole.data() + whole.size(), value);
  std::int64_t ns = 0;
  if (error != std::errc() || value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) ||
      __builtin_mul_overflow(static_cast<std::int64_t>(value), unit, &ns)) {
    return std::nullopt;
  }
  for (const char digit : fraction) {
    unit /= 10;
    if (__builtin_add_overflow(ns, unit * (digit - '0'), &ns)) {
      return std::nullopt;
    }
  }
  return ns;
}

// Consumes a number at the front; none if it is not within the limits.
std::optional<int> take_number(std::string_view& text, int least, int most) {
  const std::string digits = take_digits(text);
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return digits.empty() || error != std::errc() || value < least || value > most ? std::nullopt : std::optional(value);
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) {
    return false;
  }
  text.remove_prefix(1);
  return true;
}

std::optional<std::int64_t> take_date(std::string_view& text) {
  const auto year = take_number(text, 1677, 2262);
  const bool dash = take(text, '-');
  const auto month = take_number(text, 1, 12);
  const bool second_dash = take(text, '-');
  const auto day = take_number(text, 1, 31);
  if (!year || !dash || !month || !second_dash || !day) {
    return std::nullopt;
  }
  const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) {
    return std::nullopt;
  }
  constexpr std::int64_t kMostDays = std::numeric_limits<std::int64_t>::max() / kDay;  // before and after 1970
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  return days < -kMostDays || days > kMostDays ? std::nullopt : std::optional(days * kDay);
}

std::optional<std::int64_t> take_clock(std::string_view& text) {
  const auto hour = take_number(text, 0, 23);
  const bool colon = take(text, ':');
  const auto minute = take_number(text, 0, 59);
  if (!hour || !colon || !minute) {
    return std::nullopt;
  }
  std::int64_t ns = (std::int64_t{*hour} * 60 + *minute) * 60 * kSecond;
  if (take(text, ':')) {
    const auto second = take_number(text, 0, 59);
    const std::string fraction = take(text, '.') ? take_digits(text) : "0";
    if (!second || fraction.empty()) {
      return std::nullopt;
    }
    ns += *scaled(std::to_string(*second), fraction, kSecond);
  }
  return ns;
}

}  // namespace

TimeValue duration(std::string_view text) {
  constexpr const char* kForm = "write numbers with the units d h m s ms us ns in this order, as T#1h2m3.5s";
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) {
    text.remove_prefix(1);
  }
  std::int64_t total = 0;
  std::size_t next_unit = 0;
  bool had_fraction = false;
  bool first = true;
  if (text.empty()) {
    return wrong_time(kForm);
  }
  while (!text.empty()) {
    take(text, '_');
    const std::string whole = take_digits(text);
    const std::string fraction = take(text, '.') ? take_digits(text) : "";
    std::string unit;
    while (!text.empty() && text[0] != '_' && (text[0] < '0' || text[0] > '9')) {
      unit += upper(text.substr(0, 1));
      text.remove_prefix(1);
    }
    while (next_unit < kUnits.size() && kUnits[next_unit].name != unit) {
      ++next_unit;
    }
    if (whole.empty() || next_unit == kUnits.size() || had_fraction) {
      return wrong_time(kForm);
    }
    had_fraction = !fraction.empty();
    const Unit& own = kUnits[next_unit++];
    const auto part = scaled(whole, fraction, own.ns);
    const Unit& larger = kUnits[&own == kUnits.data() ? 0 : next_unit - 2];
    if (!first && part && *part >= larger.ns) {  // IEC 61131-3, 6.3.5: only the first unit may overflow
      return wrong_time(fmt::format("only its first number may be so large: {} {} make one {}", larger.ns / own.ns,
                                    own.name, larger.name));
    }
    first = false;
    if (!part || __builtin_add_overflow(total, *part, &total)) {
      return wrong_time("it is longer than 292 years");
    }
  }
  return {negative ? -total : total, ""};
}

TimeValue date_or_time(Elementary type, std::string_view text) {
  if (type == Elementary::TimeOfDay) {
    const auto clock = take_clock(text);
    return clock && text.empty() ? TimeValue{clock, ""} : wrong_time("write hours:minutes:seconds, as TOD#12:30:15.5");
  }
  const auto date = take_date(text);
  if (type == Elementary::Date) {
    return date && text.empty() ? TimeValue{date, ""}
                                : wrong_time("write a day from 1677-09-22 to 2262-04-11 as D#2024-01-31");
  }
  const bool dash = take(text, '-');
  const auto clock = take_clock(text);
  if (!date || !dash || !clock || !text.empty()) {
    return wrong_time("write year-month-day-hours:minutes:seconds, as DT#2024-01-31-12:30:15");
  }
  std::int64_t ns = 0;
  return __builtin_add_overflow(*date, *clock, &ns) ? wrong_time("it is after 2262-04-11-23:47:16.8")
                                                    : TimeValue{ns, ""};
}

}  // namespace indurop::plc::st
