// SPDX-License-Identifier: Apache-2.0
#include "control/plc/model/elementary.h"

#include <algorithm>
#include <array>

namespace indurop::plc {
namespace {

struct ElementaryRow {
  std::string_view name;
  unsigned bits;
};

// Same order as the enumeration.
constexpr std::array<ElementaryRow, kElementaryCount> kRows{
    {{"BOOL", 1},           {"BYTE", 8},   {"WORD", 16},   {"DWORD", 32}, {"LWORD", 64}, {"SINT", 8},
     {"INT", 16},           {"DINT", 32},  {"LINT", 64},   {"USINT", 8},  {"UINT", 16},  {"UDINT", 32},
     {"ULINT", 64},         {"REAL", 32},  {"LREAL", 64},  {"TIME", 64},  {"DATE", 64},  {"TIME_OF_DAY", 64},
     {"DATE_AND_TIME", 64}, {"STRING", 0}, {"WSTRING", 0}, {"CHAR", 8},   {"WCHAR", 16}}};

struct OtherName {
  std::string_view name;
  Elementary type;
};

// All times and dates have the resolution of the long ones; a BIT is a BOOL.
constexpr std::array<OtherName, 9> kOtherNames{{{"TOD", Elementary::TimeOfDay},
                                                {"DT", Elementary::DateAndTime},
                                                {"LTIME", Elementary::Time},
                                                {"LDATE", Elementary::Date},
                                                {"LTOD", Elementary::TimeOfDay},
                                                {"LTIME_OF_DAY", Elementary::TimeOfDay},
                                                {"LDT", Elementary::DateAndTime},
                                                {"LDATE_AND_TIME", Elementary::DateAndTime},
                                                {"BIT", Elementary::Bool}}};

constexpr const ElementaryRow& row(Elementary type) noexcept {
  return kRows[static_cast<std::size_t>(type)];
}

constexpr char upper(char c) noexcept {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

constexpr bool between(Elementary type, Elementary first, Elementary last) noexcept {
  return type >= first && type <= last;
}

}  // namespace

std::string_view name_of(Elementary type) noexcept {
  return row(type).name;
}

std::optional<Elementary> elementary_named(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    if (same_name(name, kRows[i].name)) {
      return static_cast<Elementary>(i);
    }
  }
  const auto* other = std::find_if(kOtherNames.begin(), kOtherNames.end(),
                                   [name](const OtherName& one) { return same_name(name, one.name); });
  return other == kOtherNames.end() ? std::nullopt : std::optional(other->type);
}

unsigned bits_of(Elementary type) noexcept {
  return row(type).bits;
}

bool is_signed_int(Elementary type) noexcept {
  return between(type, Elementary::Sint, Elementary::Lint);
}
bool is_unsigned_int(Elementary type) noexcept {
  return between(type, Elementary::Usint, Elementary::Ulint);
}
bool is_int(Elementary type) noexcept {
  return between(type, Elementary::Sint, Elementary::Ulint);
}
bool is_real(Elementary type) noexcept {
  return between(type, Elementary::Real, Elementary::Lreal);
}
bool is_num(Elementary type) noexcept {
  return between(type, Elementary::Sint, Elementary::Lreal);
}
bool is_bit(Elementary type) noexcept {
  return between(type, Elementary::Bool, Elementary::Lword);
}
bool is_date(Elementary type) noexcept {
  return between(type, Elementary::Date, Elementary::DateAndTime);
}
bool is_text(Elementary type) noexcept {
  return between(type, Elementary::String, Elementary::Wstring);
}
bool is_character(Elementary type) noexcept {
  return between(type, Elementary::Char, Elementary::Wchar);
}

bool widens(Elementary from, Elementary to) noexcept {
  if (from == to) {
    return true;
  }
  if (is_bit(from)) {
    return from != Elementary::Bool && is_bit(to) && bits_of(to) > bits_of(from);
  }
  if (is_int(from) && is_real(to)) {
    return bits_of(from) <= (to == Elementary::Real ? 16U : 32U);
  }
  if (is_int(from) && is_int(to)) {
    return bits_of(to) > bits_of(from) && (is_unsigned_int(from) || is_signed_int(to));
  }
  return from == Elementary::Real && to == Elementary::Lreal;
}

bool converts_in_codesys(Elementary from, Elementary to) noexcept {
  const auto whole = [](Elementary type) { return is_int(type) || (is_bit(type) && type != Elementary::Bool); };
  if (whole(from) && whole(to)) {
    return bits_of(to) >= bits_of(from);
  }
  return from == to || ((whole(from) || is_real(from)) && is_real(to));
}

std::string upper(std::string_view name) {
  std::string out(name);
  std::transform(out.begin(), out.end(), out.begin(), [](char c) { return upper(c); });
  return out;
}

bool same_name(std::string_view a, std::string_view b) noexcept {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return upper(x) == upper(y); });
}

}  // namespace indurop::plc
