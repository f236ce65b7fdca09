// SPDX-License-Identifier: Apache-2.0
#include "control/plc/library/conversions.h"

#include <array>
#include <utility>

#include "control/plc/library/signature.h"

namespace indurop::plc {
namespace {

using std::string;

constexpr std::array<std::string_view, kElementaryCount> kCppTypes{"bool",
                                                                   "std::uint8_t",
                                                                   "std::uint16_t",
                                                                   "std::uint32_t",
                                                                   "std::uint64_t",
                                                                   "std::int8_t",
                                                                   "std::int16_t",
                                                                   "std::int32_t",
                                                                   "std::int64_t",
                                                                   "std::uint8_t",
                                                                   "std::uint16_t",
                                                                   "std::uint32_t",
                                                                   "std::uint64_t",
                                                                   "float",
                                                                   "double",
                                                                   "iec::Time",
                                                                   "iec::Date",
                                                                   "iec::TimeOfDay",
                                                                   "iec::DateTime",
                                                                   "",
                                                                   "",
                                                                   "char8_t",
                                                                   "char16_t"};

constexpr Elementary type_at(std::size_t number) noexcept {
  return static_cast<Elementary>(number);
}

bool is_time(Elementary type) {
  return type == Elementary::Time || is_date(type);
}

// Returns whether a conversion between these times is useful; all others between numbers, texts and times are.
bool is_useful_between_times(Elementary from, Elementary to) {
  switch (from) {
    case Elementary::DateAndTime:
      return to == Elementary::Date || to == Elementary::TimeOfDay;
    case Elementary::Date:
      return to == Elementary::DateAndTime;
    case Elementary::TimeOfDay:
      return to == Elementary::Time;
    case Elementary::Time:
      return to == Elementary::TimeOfDay;
    default:
      return false;
  }
}

// A character converts to a number and to a text.
bool is_useful_for_character(Elementary other) {
  return is_int(other) || is_text(other) || is_character(other) || (is_bit(other) && other != Elementary::Bool);
}

bool is_useful(Elementary from, Elementary to) {
  if (is_time(from) && is_time(to)) {
    return is_useful_between_times(from, to);
  }
  if (is_character(from)) {
    return is_useful_for_character(to) && from != to;
  }
  return is_character(to) ? is_useful_for_character(from) : from != to;
}

string conversion_to(Elementary to) {
  return to == Elementary::Wstring  ? "to_wstring"
         : to == Elementary::String ? "to_string"
                                    : "to<" + string(cpp_type(to)) + ">";
}

void append(std::vector<LibraryFunction>& all, const string& name, std::string_view from, std::string_view to,
            std::string_view cpp) {
  all.push_back(make_function(name + "(IN " + string(from) + "): " + string(to), cpp));
}

void append_conversions_from(std::vector<LibraryFunction>& all, Elementary from) {
  for (std::size_t i = 0; i < kElementaryCount; ++i) {
    const Elementary to = type_at(i);
    if (is_useful(from, to)) {
      const bool literal = is_bit(from) && from != Elementary::Bool && is_text(to);
      append(all, string(name_of(from)) + "_TO_" + string(name_of(to)), name_of(from), name_of(to),
             !literal                   ? conversion_to(to)
             : to == Elementary::String ? "to_literal"
                                        : "to_wliteral");
    }
  }
}

void append_truncations(std::vector<LibraryFunction>& all) {
  append(all, "TRUNC", "ANY_REAL", "DINT", "trunc<std::int32_t>");
  for (std::size_t i = 0; i < kElementaryCount; ++i) {
    const Elementary to = type_at(i);
    if (is_int(to)) {
      const string cpp = "trunc<" + string(cpp_type(to)) + ">";
      append(all, "TRUNC_" + string(name_of(to)), "ANY_REAL", name_of(to), cpp);
      append(all, "REAL_TRUNC_" + string(name_of(to)), "REAL", name_of(to), cpp);
      append(all, "LREAL_TRUNC_" + string(name_of(to)), "LREAL", name_of(to), cpp);
    }
  }
}

void append_decimals(std::vector<LibraryFunction>& all) {
  constexpr std::pair<Elementary, Elementary> kSameWidth[] = {{Elementary::Byte, Elementary::Usint},
                                                              {Elementary::Word, Elementary::Uint},
                                                              {Elementary::Dword, Elementary::Udint},
                                                              {Elementary::Lword, Elementary::Ulint}};
  for (const auto& [bits, number] : kSameWidth) {
    append(all, "BCD_TO_" + string(name_of(number)), name_of(bits), name_of(number),
           "from_bcd<" + string(cpp_type(number)) + ">");
    append(all, string(name_of(number)) + "_TO_BCD", name_of(number), name_of(bits),
           "to_bcd<" + string(cpp_type(bits)) + ">");
  }
  append(all, "BCD_TO_INT", "BYTE", "INT", "bcd_to_int");  // as the library Util has it
  append(all, "INT_TO_BCD", "INT", "BYTE", "int_to_bcd");
  for (const Elementary bits : {Elementary::Byte, Elementary::Word, Elementary::Dword, Elementary::Lword}) {
    for (const Elementary number : {Elementary::Usint, Elementary::Uint, Elementary::Udint, Elementary::Ulint}) {
      append(all, string(name_of(bits)) + "_BCD_TO_" + string(name_of(number)), name_of(bits), name_of(number),
             "from_bcd<" + string(cpp_type(number)) + ">");
      append(all, string(name_of(number)) + "_TO_BCD_" + string(name_of(bits)), name_of(number), name_of(bits),
             "to_bcd<" + string(cpp_type(bits)) + ">");
    }
  }
}

// Returns "TOD_TO_DT" (`separator` "_TO_") with the full type names on both sides; empty if one of them is not a type.
string in_full(const string& name, std::string_view separator) {
  const std::size_t at = name.find(separator);
  if (at == string::npos) {
    return "";
  }
  const auto to = elementary_named(std::string_view(name).substr(at + separator.size()));
  if (at == 0) {
    return to ? string(separator) + string(name_of(*to)) : "";
  }
  const auto from = elementary_named(std::string_view(name).substr(0, at));
  return from && to ? string(name_of(*from)) + string(separator) + string(name_of(*to)) : "";
}

}  // namespace

std::string_view cpp_type(Elementary type) noexcept {
  return kCppTypes[static_cast<std::size_t>(type)];
}

void append_conversions(std::vector<LibraryFunction>& all) {
  for (std::size_t i = 0; i < kElementaryCount; ++i) {
    append_conversions_from(all, type_at(i));
  }
  for (std::size_t i = 0; i < kElementaryCount; ++i) {
    const Elementary to = type_at(i);
    if (!is_date(to)) {
      append(all, "TO_" + string(name_of(to)), "ANY_ELEMENTARY", name_of(to), conversion_to(to));
    }
  }
  append_truncations(all);
  append_decimals(all);
}

string with_long_type_names(std::string_view name) {
  const string capitals = upper(name);
  string full = in_full(capitals, "_TO_");
  if (full.empty() && capitals.starts_with("TO_")) {
    full = in_full(capitals, "TO_");
  }
  return full.empty() ? capitals : full;
}

}  // namespace indurop::plc
