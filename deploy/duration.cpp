// SPDX-License-Identifier: Apache-2.0
// Durations as text: "500000", "100us", "0.5ms", "10kHz".

#include <algorithm>
#include <array>
#include <limits>

#include "deploy/reader.h"
#include "deploy/text.h"
#include "deploy/values.h"

namespace indurop::deploy {
namespace {

constexpr std::int64_t kLongest = std::numeric_limits<std::int64_t>::max();

struct Unit {
  std::string_view name;
  std::int64_t nanos;  // of one; 0: a frequency
  std::int64_t hertz;  // of one; 0: a time
};
constexpr std::array<Unit, 11> kUnits{{
    {"", 1, 0},
    {"ns", 1, 0},
    {"us", 1'000, 0},
    {"\xC2\xB5s", 1'000, 0},  // micro sign
    {"\xCE\xBCs", 1'000, 0},  // Greek mu
    {"ms", 1'000'000, 0},
    {"s", 1'000'000'000, 0},
    {"min", 60'000'000'000, 0},
    {"Hz", 0, 1},
    {"kHz", 0, 1'000},
    {"MHz", 0, 1'000'000},
}};
constexpr std::string_view kForms = "write nanoseconds (100000) or a number with a unit: 100us, 0.5ms, 2s, 10kHz";

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) {
    text.remove_prefix(1);
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) {
    text.remove_suffix(1);
  }
  return text;
}

// digits / scale, scale a power of ten.
struct Decimal {
  std::int64_t digits = 0;
  std::int64_t scale = 1;
};

// Takes a decimal number off the front of `text`. Empty: does not start with one, or has more digits than fit.
std::optional<Decimal> take_decimal(std::string_view& text, bool& too_large) {
  Decimal number;
  bool any = false;
  bool fraction = false;
  std::size_t used = 0;
  for (; used < text.size(); ++used) {
    const char c = text[used];
    if (c == '.' && !fraction && any) {
      fraction = true;
      continue;
    }
    if (!is_digit(c)) {
      break;
    }
    any = true;
    const int digit = c - '0';
    if (number.digits > (kLongest - digit) / 10 || (fraction && number.scale > kLongest / 10)) {
      too_large = true;
      return std::nullopt;
    }
    number.digits = number.digits * 10 + digit;
    number.scale *= fraction ? 10 : 1;
  }
  if (!any || text[used - 1] == '.') {
    return std::nullopt;
  }
  text.remove_prefix(used);
  while (number.scale > 1 && number.digits % 10 == 0) {
    number.digits /= 10;
    number.scale /= 10;
  }
  return number;
}

DurationText problem(std::string text) {
  return {std::nullopt, std::move(text)};
}

DurationText from_time(std::string_view text, Decimal number, std::int64_t unit) {
  // Common factors first: "0.000001s" is exact.
  std::int64_t scale = number.scale;
  while (scale > 1 && unit % 10 == 0) {
    scale /= 10;
    unit /= 10;
  }
  if (number.digits > kLongest / unit) {
    return problem(in_quotes(text) + " is longer than 292 years; " + std::string(kForms));
  }
  const std::int64_t nanos = number.digits * unit;
  if (nanos % scale != 0) {
    return problem(in_quotes(text) + " is not a whole number of nanoseconds; round it");
  }
  return {Nanos{nanos / scale}, {}};
}

DurationText from_frequency(std::string_view text, Decimal number, std::int64_t hertz) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  if (number.digits == 0) {
    return problem(in_quotes(text) + " never comes; a frequency must be above 0");
  }
  // period = 1e9 * scale / (digits * hertz), rounded to the nearest nanosecond
  if (number.scale > kLongest / kSecond || number.digits > kLongest / hertz) {
    return problem(in_quotes(text) + " is outside of what a period can be; " + std::string(kForms));
  }
  const std::int64_t numerator = kSecond * number.scale;
  const std::int64_t denominator = number.digits * hertz;
  const std::int64_t nanos =
      numerator / denominator + (numerator % denominator >= denominator - denominator / 2 ? 1 : 0);
  if (nanos == 0) {
    return problem(in_quotes(text) + " is faster than one nanosecond; " + std::string(kForms));
  }
  return {Nanos{nanos}, {}};
}

}  // namespace

DurationText read_duration(std::string_view text, bool zero_allowed) {
  const std::string_view whole = trim(text);
  if (whole.empty()) {
    return problem("no value given; " + std::string(kForms));
  }
  if (whole.front() == '-') {
    return problem(in_quotes(whole) + " is negative; " + std::string(kForms));
  }
  std::string_view rest = whole;
  bool too_large = false;
  const auto number = take_decimal(rest, too_large);
  if (!number) {
    return problem(in_quotes(whole) +
                   (too_large ? " has more digits than a duration can have; " : " is not a duration; ") +
                   std::string(kForms));
  }
  rest = trim(rest);
  const auto* unit = std::find_if(kUnits.begin(), kUnits.end(), [rest](const Unit& u) { return u.name == rest; });
  if (unit == kUnits.end()) {
    return problem(in_quotes(whole) + ": unknown unit " + in_quotes(rest) +
                   "; units are ns, us, ms, s, min, Hz, kHz, MHz");
  }
  DurationText result =
      unit->hertz != 0 ? from_frequency(whole, *number, unit->hertz) : from_time(whole, *number, unit->nanos);
  if (result.value == Nanos::zero() && !zero_allowed) {
    return problem("0 is not possible here; " + std::string(kForms));
  }
  return result;
}

std::optional<Nanos> parse_duration(std::string_view text) {
  return read_duration(text, false).value;
}

std::string format_duration(Nanos value) {
  // The largest unit that needs at most three decimals, so that every digit is shown.
  struct Step {
    std::int64_t nanos;
    std::string_view name;
  };
  constexpr std::array<Step, 4> kSteps{{{1'000'000'000, "s"}, {1'000'000, "ms"}, {1'000, "us"}, {1, "ns"}}};
  if (value < Nanos::zero()) {
    if (value == Nanos::min()) {
      return std::to_string(value.count()) + " ns";
    }
    return "-" + format_duration(-value);
  }
  const std::int64_t nanos = value.count();
  for (const Step& step : kSteps) {
    const std::int64_t thousandth = std::max<std::int64_t>(step.nanos / 1'000, 1);
    if (nanos < step.nanos || nanos % thousandth != 0) {
      continue;
    }
    std::string text = std::to_string(nanos / step.nanos);
    const std::int64_t rest = nanos % step.nanos / thousandth;
    if (rest != 0) {
      std::string decimals = std::to_string(rest);
      decimals.insert(0, 3 - decimals.size(), '0');
      decimals.erase(decimals.find_last_not_of('0') + 1);
      text += "." + decimals;
    }
    return text + " " + std::string(step.name);
  }
  return std::to_string(nanos) + " ns";
}

}  // namespace indurop::deploy
