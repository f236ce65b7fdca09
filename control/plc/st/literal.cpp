// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/literal.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "control/plc/model/characters.h"
#include "control/plc/st/letters.h"
#include "control/plc/st/time_literal.h"

namespace indurop::plc::st {
namespace {

int digit_value(char c) noexcept {
  if (is_digit(c)) {
    return c - '0';
  }
  const char big = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return big >= 'A' && big <= 'F' ? big - 'A' + 10 : 99;
}

Literal wrong(std::string why) {
  Literal out;
  out.why = std::move(why);
  return out;
}

// Returns true for digits with single '_' between them.
bool well_formed(std::string_view digits) noexcept {
  return !digits.empty() && digits.front() != '_' && digits.back() != '_' &&
         digits.find("__") == std::string_view::npos;
}

Literal integer(std::string_view digits, unsigned base, std::string_view whole) {
  if (!well_formed(digits)) {
    return wrong(fmt::format("'{}' is not a number, write digits with at most one '_' between them", whole));
  }
  std::uint64_t value = 0;
  for (const char c : digits) {
    if (c == '_') {
      continue;
    }
    const auto digit = static_cast<unsigned>(digit_value(c));
    if (digit >= base) {
      return wrong(fmt::format("'{}' is not a digit of a number of base {}, correct '{}'", c, base, whole));
    }
    if (value > (std::numeric_limits<std::uint64_t>::max() - digit) / base) {
      return wrong(fmt::format("'{}' does not fit 64 bits, use a smaller number", whole));
    }
    value = value * base + digit;
  }
  Literal out;
  out.value = value;
  return out;
}

Literal real(std::string_view text) {
  std::string digits(text);
  std::erase(digits, '_');
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    return wrong(fmt::format("'{}' does not fit LREAL, use a smaller exponent", text));
  }
  if (error != std::errc() || end != digits.data() + digits.size()) {
    return wrong(fmt::format("'{}' is not a number, write it as 1.5 or 1.5E-3", text));
  }
  Literal out;
  out.value = value;
  return out;
}

Literal boolean(std::string_view text, std::string_view whole) {
  const bool yes = text == "1" || same_name(text, "TRUE");
  if (!yes && text != "0" && !same_name(text, "FALSE")) {
    return wrong(fmt::format("'{}' is not a BOOL, write TRUE or FALSE", whole));
  }
  Literal out;
  out.value = yes;
  return out;
}

// Evaluates a number after INT#, WORD#, REAL#.
Literal typed_number(Elementary type, std::string_view text, std::string_view whole) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) {
    text.remove_prefix(1);
  }
  if (text.empty() || !is_digit(text.front())) {
    return wrong(fmt::format("'{}' is not a value of {}, write a number after '#'", whole, name_of(type)));
  }
  Literal out = number_literal(text);
  if (!out.value) {
    return out;
  }
  if (negative && (is_bit(type) || is_character(type))) {
    return wrong(fmt::format("'{}' is negative, but {} has no sign, remove the sign", whole, name_of(type)));
  }
  if (std::holds_alternative<double>(*out.value) && !is_real(type)) {
    return wrong(fmt::format("'{}' is not a whole number, and {} is not a real type", whole, name_of(type)));
  }
  if (is_real(type) && std::holds_alternative<std::uint64_t>(*out.value)) {
    out.value = static_cast<double>(std::get<std::uint64_t>(*out.value));
  }
  out.negative = negative;
  return out;
}

// Returns the character for the one after '$'; nullopt if it has no meaning.
std::optional<char> escaped(char c) noexcept {
  switch (c) {
    case '$':
    case '\'':
    case '"':
      return c;
    case 'L':
    case 'l':
    case 'N':
    case 'n':
      return '\n';
    case 'P':
    case 'p':
      return '\f';
    case 'R':
    case 'r':
      return '\r';
    case 'T':
    case 't':
      return '\t';
    default:
      return std::nullopt;
  }
}

// Appends text between escapes: characters of two bytes, or bytes.
void append(std::string_view plain, bool wide, std::u16string& out) {
  if (wide) {
    out += to_wide(plain);
    return;
  }
  for (const char c : plain) {
    out += static_cast<char16_t>(static_cast<unsigned char>(c));
  }
}

std::optional<char16_t> hexadecimal(std::string_view text, std::size_t digits) noexcept {
  unsigned value = 0;
  for (const char c : text) {
    if (digit_value(c) >= 16) {
      return std::nullopt;
    }
    value = value * 16 + static_cast<unsigned>(digit_value(c));
  }
  return text.size() == digits ? std::optional(static_cast<char16_t>(value)) : std::nullopt;
}

// Evaluates 'a' of CHAR#'a', "a" of WCHAR#"a".
Literal character(Elementary type, std::string_view quoted, std::string_view whole) {
  const bool wide = type == Elementary::Wchar;
  Literal out = text_literal(quoted);
  if (!out.value) {
    return out;
  }
  const auto code = code_of_character(std::get<std::string>(*out.value), type);
  if (out.type != (wide ? Elementary::Wstring : Elementary::String) || !code) {
    return wrong(fmt::format("'{}' is not one character, write {}", whole, wide ? "WCHAR#\"a\"" : "CHAR#'a'"));
  }
  out.value = std::uint64_t{*code};
  return out;
}

}  // namespace

Literal number_literal(std::string_view text) {
  if (const std::size_t hash = text.find('#'); hash != std::string_view::npos) {
    const std::string_view base = text.substr(0, hash);
    if (base != "2" && base != "8" && base != "10" && base != "16") {
      return wrong(fmt::format("there are no numbers of base {}, use 2#, 8#, 10# or 16#", base));
    }
    const unsigned binary_or_octal = base == "2" ? 2 : 8;
    const unsigned decimal_or_more = base == "10" ? 10 : 16;
    return integer(text.substr(hash + 1), base == "2" || base == "8" ? binary_or_octal : decimal_or_more, text);
  }
  const bool has_exponent = text.find_first_of("eE") != std::string_view::npos;
  return text.find('.') != std::string_view::npos || has_exponent ? real(text) : integer(text, 10, text);
}

Literal typed_literal(std::string_view text) {
  const std::size_t hash = text.find('#');
  const std::string_view prefix = text.substr(0, hash);
  const std::string_view rest = text.substr(hash + 1);
  auto type = elementary_named(prefix);
  if (same_name(prefix, "T") || same_name(prefix, "LT")) {
    type = Elementary::Time;
  } else if (same_name(prefix, "D") || same_name(prefix, "LD")) {
    type = Elementary::Date;
  }
  if (!type) {
    return {};
  }
  Literal out;
  if (*type == Elementary::Time || is_date(*type)) {
    const TimeValue found = *type == Elementary::Time ? duration(rest) : date_or_time(*type, rest);
    if (!found.ns) {
      return wrong(fmt::format("'{}' is not a valid {}: {}", text, name_of(*type), found.why));
    }
    out.value = *found.ns;
  } else if (*type == Elementary::Bool) {
    out = boolean(rest, text);
  } else if (is_text(*type)) {
    return wrong(*type == Elementary::String ? "write the text alone: 'text'" : "write the text alone: \"text\"");
  } else if (is_character(*type) && rest.find_first_of("'\"") == 0) {
    out = character(*type, rest, text);
  } else {
    out = typed_number(*type, rest, text);
  }
  out.type = type;
  return out;
}

Literal text_literal(std::string_view quoted) {
  const bool wide = quoted.starts_with('"');
  const std::string_view text = quoted.size() < 2 ? std::string_view() : quoted.substr(1, quoted.size() - 2);
  const std::size_t digits = wide ? 4 : 2;
  std::u16string decoded;  // bytes, if it is a STRING
  std::size_t plain = 0;
  const auto take_plain = [&](std::size_t end) {
    append(text.substr(plain, end - plain), wide, decoded);
    plain = end;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '$') {
      continue;
    }
    take_plain(i);
    if (const auto code = hexadecimal(text.substr(i + 1, digits), digits)) {
      decoded += *code;
      i += digits;
    } else if (const auto c = i + 1 < text.size() ? escaped(text[i + 1]) : std::nullopt) {
      decoded += static_cast<char16_t>(*c);
      ++i;
    } else {
      return wrong(
          fmt::format("'$' begins one of $$ $' $\" $L $N $P $R $T ${} ({} hexadecimal digits), write $$ for the "
                      "character itself",
                      wide ? "hhhh" : "hh", wide ? "four" : "two"));
    }
    plain = i + 1;
  }
  take_plain(text.size());
  if (decoded.find(u'\0') != std::u16string::npos) {
    return wrong(wide ? "a text cannot contain the character $0000, remove it"
                      : "a text cannot contain the character $00, remove it");
  }
  Literal out;
  out.value = wide ? to_utf8(decoded) : std::string(decoded.begin(), decoded.end());
  out.type = wide ? Elementary::Wstring : Elementary::String;
  return out;
}

std::optional<ast::DirectAddress> address_literal(std::string_view text) {
  ast::DirectAddress out;
  std::size_t at = 1;
  const auto letter = [&]() -> char { return at < text.size() ? upper(text.substr(at, 1))[0] : '\0'; };
  if (std::string_view("IQM").find(letter()) == std::string_view::npos || letter() == '\0') {
    return std::nullopt;
  }
  out.area = letter();
  ++at;
  if (letter() != '\0' && std::string_view("XBWDL").find(letter()) != std::string_view::npos) {
    out.size = letter();
    ++at;
  }
  if (text.substr(at) == "*") {
    return out;  // AT %I*: the address is open
  }
  while (at < text.size()) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), number);
    if (error != std::errc() || number < 0) {
      return std::nullopt;
    }
    out.numbers.push_back(number);
    at = static_cast<std::size_t>(end - text.data());
    if (at < text.size() && (text[at] != '.' || ++at == text.size())) {
      return std::nullopt;
    }
  }
  constexpr std::size_t kMostNumbers = 8;
  return out.numbers.empty() || out.numbers.size() > kMostNumbers ? std::nullopt : std::optional(out);
}

}  // namespace indurop::plc::st
