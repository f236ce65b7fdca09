// SPDX-License-Identifier: Apache-2.0
// X_TO_STRING: values as text, in the form of the literals of IEC 61131-3 ('12', '1.5', 'TRUE', 'T#1m30s',
// 'D#2024-01-31'). Real-time safe.

#pragma once

#include <indurop/plc/calendar.h>
#include <indurop/plc/types.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <system_error>

namespace indurop::iec {

namespace detail {

// Collects a short text; requires that it fits into `N` characters.
template <std::size_t N>
class Writer {
 public:
  void put(std::string_view part) noexcept {
    std::memcpy(text_.data + used_, part.data(), part.size());
    used_ += part.size();
  }
  template <class T>
  void number(T value) noexcept {
    used_ = static_cast<std::size_t>(std::to_chars(text_.data + used_, text_.data + N, value).ptr - text_.data);
  }
  // Writes a number with leading zeros.
  void digits(std::int64_t value, int width) noexcept {
    for (int i = width - 1; i >= 0; --i) {
      text_.data[used_ + static_cast<std::size_t>(i)] = static_cast<char>('0' + value % 10);
      value /= 10;
    }
    used_ += static_cast<std::size_t>(width);
  }
  [[nodiscard]] const String<N>& text() const noexcept { return text_; }

 private:
  String<N> text_;
  std::size_t used_ = 0;
};

template <std::size_t N>
void write_date(Writer<N>& out, std::int64_t ns) noexcept {
  const Civil civil = civil_of(floor_div(ns, kDay));
  out.digits(civil.year, 4);
  out.put("-");
  out.digits(civil.month, 2);
  out.put("-");
  out.digits(civil.day, 2);
}

// Writes 12:34:56, with as many groups of three decimals as needed.
template <std::size_t N>
void write_time_of_day(Writer<N>& out, std::int64_t ns) noexcept {
  out.digits(ns / kHour, 2);
  out.put(":");
  out.digits(ns / kMinute % 60, 2);
  out.put(":");
  out.digits(ns / kSecond % 60, 2);
  const std::int64_t fraction = ns % kSecond;
  if (fraction == 0) {
    return;
  }
  out.put(".");
  if (fraction % kMillisecond == 0) {
    out.digits(fraction / kMillisecond, 3);
  } else if (fraction % kMicrosecond == 0) {
    out.digits(fraction / kMicrosecond, 6);
  } else {
    out.digits(fraction, 9);
  }
}

// The shortest decimal text that reads back as the same value, with a decimal point: "1.0", "1.0e+30"; or "NaN", "INF".
template <Real T>
String<32> write_real(T value) noexcept {
  if (std::isnan(value)) {
    return "NaN";
  }
  if (std::isinf(value)) {
    return value < 0 ? "-INF" : "INF";
  }
  char buffer[32];
  const std::string_view text(
      buffer, static_cast<std::size_t>(std::to_chars(buffer, buffer + sizeof buffer, value).ptr - buffer));
  const std::size_t exponent = text.find('e');
  const std::string_view mantissa = text.substr(0, exponent);
  Writer<32> out;
  out.put(mantissa);
  if (mantissa.find('.') == std::string_view::npos) {
    out.put(".0");
  }
  if (exponent != std::string_view::npos) {
    out.put(text.substr(exponent));
  }
  return out.text();
}

}  // namespace detail

inline String<5> to_string(bool value) noexcept {
  return value ? "TRUE" : "FALSE";
}

template <NarrowText T>
T to_string(const T& value) noexcept {
  return value;
}

template <Integer T>
String<20> to_string(T value) noexcept {
  detail::Writer<20> out;
  out.number(value);
  return out.text();
}

// A bit string as its literal: '16#2a'.
template <BitString T>
String<20> to_literal(T value) noexcept {
  constexpr const char* kDigits = "0123456789abcdef";
  char text[20] = "16#";
  std::size_t size = 3;
  for (int shift = std::numeric_limits<T>::digits - 4; shift >= 0; shift -= 4) {
    const auto digit = (std::uint64_t{value} >> shift) & 0xFU;
    if (digit != 0 || size > 3 || shift == 0) {
      text[size++] = kDigits[digit];
    }
  }
  return std::string_view(text, size);
}

template <Real T>
String<32> to_string(T value) noexcept {
  return detail::write_real(value);
}

// 'T#1d2h3m4s5ms6us7ns' without the zero parts.
inline String<48> to_string(Time value) noexcept {
  struct Unit {
    std::uint64_t ns;
    const char* name;
  };
  constexpr Unit kUnits[] = {{kDay, "d"},          {kHour, "h"},         {kMinute, "m"}, {kSecond, "s"},
                             {kMillisecond, "ms"}, {kMicrosecond, "us"}, {1, "ns"}};
  detail::Writer<48> out;
  out.put(value.ns < 0 ? "T#-" : "T#");
  std::uint64_t rest = value.ns < 0 ? 0U - static_cast<std::uint64_t>(value.ns) : static_cast<std::uint64_t>(value.ns);
  if (rest == 0) {
    out.put("0s");
  }
  for (const Unit& unit : kUnits) {
    if (rest >= unit.ns) {
      out.number(rest / unit.ns);
      out.put(unit.name);
      rest %= unit.ns;
    }
  }
  return out.text();
}

inline String<32> to_string(Date value) noexcept {
  detail::Writer<32> out;
  out.put("D#");
  detail::write_date(out, value.ns);
  return out.text();
}

inline String<32> to_string(TimeOfDay value) noexcept {
  detail::Writer<32> out;
  out.put("TOD#");
  detail::write_time_of_day(out, detail::normalized<TimeOfDay>(value.ns).ns);
  return out.text();
}

inline String<48> to_string(DateTime value) noexcept {
  detail::Writer<48> out;
  out.put("DT#");
  detail::write_date(out, value.ns);
  out.put("-");
  detail::write_time_of_day(out, detail::normalized<TimeOfDay>(value.ns).ns);
  return out.text();
}

}  // namespace indurop::iec
