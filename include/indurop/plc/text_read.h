// SPDX-License-Identifier: Apache-2.0
// STRING_TO_X: parses the beginning of a text, after blanks, and ignores the rest; returns 0 or FALSE if nothing can be
// read. Accepts literals of IEC 61131-3 with their underscores: '16#FF', '1_000', 'T#1m30s', 'D#2024-01-31', also
// without the prefix. Saturates at the range of a number. Real-time safe.

#pragma once

#include <indurop/plc/calendar.h>
#include <indurop/plc/types.h>
#include <indurop/plc/unicode.h>

#include <charconv>
#include <limits>
#include <string_view>
#include <system_error>

namespace indurop::iec {

namespace detail {

constexpr char lower(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
constexpr int digit_of(char c) noexcept {
  if (c >= '0' && c <= '9') {
    return c - '0';
  }
  return lower(c) >= 'a' && lower(c) <= 'f' ? lower(c) - 'a' + 10 : 99;
}

class Reader {
 public:
  explicit Reader(std::string_view text) noexcept : rest_(text) {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t')) {
      rest_.remove_prefix(1);
    }
  }

  [[nodiscard]] bool at_digit() const noexcept { return !rest_.empty() && digit_of(rest_.front()) < 10; }
  [[nodiscard]] std::string_view rest() const noexcept { return rest_; }

  bool skip(char c) noexcept {
    const bool there = !rest_.empty() && lower(rest_.front()) == lower(c);
    rest_.remove_prefix(there ? 1 : 0);
    return there;
  }
  // Skips all of `word`, ignoring case, or nothing.
  bool skip(std::string_view word) noexcept {
    Reader ahead = *this;
    for (const char c : word) {
      if (!ahead.skip(c)) {
        return false;
      }
    }
    *this = ahead;
    return true;
  }
  // Returns true after "-"; also skips a "+".
  bool minus() noexcept {
    const bool negative = skip('-');
    if (!negative) {
      skip('+');
    }
    return negative;
  }

  // Reads digits and underscores; returns the maximum number on overflow.
  std::uint64_t digits(unsigned base = 10) noexcept {
    constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t value = 0;
    for (; !rest_.empty(); rest_.remove_prefix(1)) {
      const auto digit = static_cast<std::uint64_t>(digit_of(rest_.front()));
      if (digit < base) {
        value = value > (kMax - digit) / base ? kMax : value * base + digit;
      } else if (rest_.front() != '_') {
        break;
      }
    }
    return value;
  }
  // Reads the decimals after a point, in units of `unit` ns.
  std::int64_t fraction(std::int64_t unit) noexcept {
    std::int64_t sum = 0;
    for (; at_digit(); rest_.remove_prefix(1)) {
      unit /= 10;
      sum += digit_of(rest_.front()) * unit;
    }
    return sum;
  }
  // Skips everything up to and including '#', if there is one.
  void skip_prefix() noexcept {
    const std::size_t hash = rest_.find('#');
    rest_.remove_prefix(hash == std::string_view::npos ? 0 : hash + 1);
  }

 private:
  std::string_view rest_;
};

template <Integer T>
T read_integer(std::string_view text) noexcept {
  Reader in(text);
  const bool negative = in.minus();
  std::uint64_t size = in.digits();
  if ((size == 2 || size == 8 || size == 16) && in.skip('#')) {
    size = in.digits(static_cast<unsigned>(size));
  }
  const auto max = static_cast<std::uint64_t>(std::numeric_limits<T>::max());
  if (!negative) {
    return size > max ? std::numeric_limits<T>::max() : static_cast<T>(size);
  }
  if (std::unsigned_integral<T>) {
    return T{};
  }
  return size > max ? std::numeric_limits<T>::min() : neg(static_cast<T>(size));
}

template <Real T>
T read_real(std::string_view text) noexcept {
  Reader in(text);
  in.skip('+');
  char buffer[128];  // from_chars() does not accept underscores
  std::size_t used = 0;
  for (const char c : in.rest()) {
    if (used < sizeof buffer && c != '_') {
      buffer[used++] = c;
    }
  }
  T value{};
  const auto end = std::from_chars(buffer, buffer + used, value, std::chars_format::general);
  if (end.ec == std::errc::result_out_of_range) {
    const std::string_view number(buffer, static_cast<std::size_t>(end.ptr - buffer));
    const bool tiny = number.find("e-") != std::string_view::npos || number.find("E-") != std::string_view::npos;
    value = tiny ? T{} : std::numeric_limits<T>::max();
    return number.front() == '-' ? -value : value;
  }
  return end.ec == std::errc{} ? value : T{};
}

inline bool read_bool(std::string_view text) noexcept {
  Reader in(text);
  return in.skip("TRUE") || read_integer<std::int64_t>(text) != 0;
}

// Reads the unit that follows; returns 0 if there is none.
inline std::int64_t read_unit(Reader& in) noexcept {
  struct Unit {
    const char* name;
    std::int64_t ns;
  };
  // Longer names first, so that "ms" is not read as minutes.
  constexpr Unit kUnits[] = {{"ms", kMillisecond}, {"us", kMicrosecond}, {"ns", 1},     {"d", kDay},
                             {"h", kHour},         {"m", kMinute},       {"s", kSecond}};
  for (const Unit& unit : kUnits) {
    if (in.skip(unit.name)) {
      return unit.ns;
    }
  }
  return 0;
}

inline Time read_duration(std::string_view text) noexcept {
  Reader in(text);
  in.skip_prefix();
  const bool negative = in.minus();
  std::int64_t sum = 0;
  while (in.at_digit()) {
    const auto whole = static_cast<std::int64_t>(in.digits());
    Reader decimals = in;
    if (in.skip('.')) {
      decimals = in;
      in.fraction(1);
    }
    const std::int64_t unit = read_unit(in);
    sum = add(add(sum, mul(whole, unit)), decimals.fraction(unit));
    in.skip('_');
  }
  return {negative ? neg(sum) : sum};
}

// Reads "12:34:56.789"; the seconds may be missing.
inline std::int64_t read_time_of_day(Reader& in) noexcept {
  std::int64_t ns = mul(static_cast<std::int64_t>(in.digits()), kHour);
  if (in.skip(':')) {
    ns = add(ns, mul(static_cast<std::int64_t>(in.digits()), kMinute));
  }
  if (in.skip(':')) {
    ns = add(ns, mul(static_cast<std::int64_t>(in.digits()), kSecond));
  }
  if (in.skip('.')) {
    ns = add(ns, in.fraction(kSecond));
  }
  return normalized<TimeOfDay>(ns).ns;
}

// Reads "2024-01-31"; returns 1970-01-01 if it is not a date.
inline Date read_date(Reader& in) noexcept {
  const std::uint64_t year = in.digits();
  if (!in.skip('-')) {
    return {};
  }
  const std::uint64_t month = in.digits();
  if (!in.skip('-')) {
    return {};
  }
  return concat_date(year, month, in.digits());
}

}  // namespace detail

// STRING_TO_X is to<X>(text); STRING_TO_CHAR is its first byte, 0 if there is none.
template <Scalar To, NarrowText From>
To to(const From& text) noexcept {
  if constexpr (std::same_as<To, bool>) {
    return detail::read_bool(text.view());
  } else if constexpr (std::same_as<To, char8_t>) {
    return text.size() == 0 ? u8'\0' : static_cast<char8_t>(text.view()[0]);
  } else if constexpr (std::same_as<To, char16_t>) {
    return text.size() == 0 ? u'\0' : detail::first_wide(text.view());
  } else if constexpr (Integer<To>) {
    return detail::read_integer<To>(text.view());
  } else if constexpr (Real<To>) {
    return detail::read_real<To>(text.view());
  } else if constexpr (std::same_as<To, Time>) {
    return detail::read_duration(text.view());
  } else {
    detail::Reader in(text.view());
    in.skip_prefix();
    if constexpr (std::same_as<To, TimeOfDay>) {
      return {detail::read_time_of_day(in)};
    } else {
      const Date date = detail::read_date(in);
      if constexpr (std::same_as<To, Date>) {
        return date;
      } else {
        return concat_date_tod(date, {in.skip('-') ? detail::read_time_of_day(in) : 0});
      }
    }
  }
}

}  // namespace indurop::iec
