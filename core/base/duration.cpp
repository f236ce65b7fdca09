// SPDX-License-Identifier: Apache-2.0
#include "core/base/duration.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/base/text.h"

namespace indurop::base {
namespace {

constexpr std::int64_t kLongestDuration = std::numeric_limits<std::int64_t>::max();

struct Unit {
  std::string_view name;
  std::int64_t nanos;  // of one unit; 0: a frequency
  std::int64_t hertz;  // of one unit; 0: a time
};
constexpr std::array<Unit, 12> kUnits{{
    {"", 1, 0},
    {"ns", 1, 0},
    {"us", 1'000, 0},
    {"\xC2\xB5s", 1'000, 0},  // micro sign
    {"\xCE\xBCs", 1'000, 0},  // Greek mu
    {"ms", 1'000'000, 0},
    {"s", 1'000'000'000, 0},
    {"min", 60'000'000'000, 0},
    {"h", 3'600'000'000'000, 0},
    {"Hz", 0, 1},
    {"kHz", 0, 1'000},
    {"MHz", 0, 1'000'000},
}};
constexpr std::string_view kNanosecondForms =
    "write nanoseconds (100000) or a number with a unit: 100us, 0.5ms, 2s, 10kHz";
constexpr std::string_view kSecondForms = "write seconds (2, 0.5) or a number with a unit: 500ms, 2s, 1min";

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

// digits / scale, scale a power of ten.
struct Decimal {
  std::int64_t digits = 0;
  std::int64_t scale = 1;
};

// Removes a decimal number from the front of `text`. Empty: does not start with one, or has more digits than fit.
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
    if (number.digits > (kLongestDuration - digit) / 10 || (fraction && number.scale > kLongestDuration / 10)) {
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

// The text being read, for messages about it.
struct Subject {
  std::string_view text;
  std::string_view forms;
  [[nodiscard]] DurationText is(std::string_view what) const {
    return problem(in_quotes(text) + std::string(what) + "; " + std::string(forms));
  }
};

DurationText from_time(const Subject& subject, Decimal number, std::int64_t unit) {
  // Common factors first: "0.000001s" is exact.
  std::int64_t scale = number.scale;
  while (scale > 1 && unit % 10 == 0) {
    scale /= 10;
    unit /= 10;
  }
  if (number.digits > kLongestDuration / unit) {
    return subject.is(" is longer than 292 years");
  }
  const std::int64_t nanos = number.digits * unit;
  if (nanos % scale != 0) {
    return problem(in_quotes(subject.text) + " is not a whole number of nanoseconds; round it");
  }
  return {Nanos{nanos / scale}, {}};
}

DurationText from_frequency(const Subject& subject, Decimal number, std::int64_t hertz) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  if (number.digits == 0) {
    return problem(in_quotes(subject.text) + " never comes; a frequency must be above 0");
  }
  // period = 1e9 * scale / (digits * hertz), rounded to the nearest nanosecond
  if (number.scale > kLongestDuration / kSecond || number.digits > kLongestDuration / hertz) {
    return subject.is(" is outside of what a period can be");
  }
  const std::int64_t numerator = kSecond * number.scale;
  const std::int64_t denominator = number.digits * hertz;
  const std::int64_t nanos =
      numerator / denominator + (numerator % denominator >= denominator - denominator / 2 ? 1 : 0);
  return nanos == 0 ? subject.is(" is faster than one nanosecond") : DurationText{Nanos{nanos}, {}};
}

}  // namespace

DurationText read_duration(std::string_view text, bool zero_allowed, PlainNumber plain) {
  const bool seconds = plain == PlainNumber::Seconds;
  const Subject subject{trimmed(text), seconds ? kSecondForms : kNanosecondForms};
  if (subject.text.empty()) {
    return problem("no value given; " + std::string(subject.forms));
  }
  if (subject.text.front() == '-') {
    return subject.is(" is negative");
  }
  std::string_view rest = subject.text;
  bool too_large = false;
  const auto number = take_decimal(rest, too_large);
  if (!number) {
    return subject.is(too_large ? " has more digits than a duration can have" : " is not a duration");
  }
  rest = trimmed(rest);
  const std::string_view name = rest.empty() && seconds ? "s" : rest;
  const auto* unit = std::find_if(kUnits.begin(), kUnits.end(), [name](const Unit& u) { return u.name == name; });
  if (unit == kUnits.end()) {
    return problem(in_quotes(subject.text) + ": unknown unit " + in_quotes(rest) +
                   "; units are ns, us, ms, s, min, h, Hz, kHz, MHz");
  }
  DurationText result =
      unit->hertz != 0 ? from_frequency(subject, *number, unit->hertz) : from_time(subject, *number, unit->nanos);
  if (result.value == Nanos::zero() && !zero_allowed) {
    return problem("0 is not possible here; " + std::string(subject.forms));
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

}  // namespace indurop::base
