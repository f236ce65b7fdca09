// SPDX-License-Identifier: Apache-2.0
// The elementary data types of IEC 61131-3: their names, sizes and families.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace indurop::plc {

enum class Elementary : std::uint8_t {
  Bool,
  Byte,
  Word,
  Dword,
  Lword,
  Sint,
  Int,
  Dint,
  Lint,
  Usint,
  Uint,
  Udint,
  Ulint,
  Real,
  Lreal,
  Time,  // LTIME is the same type: both count nanoseconds in 64 bits; likewise LDATE, LTOD, LDT
  Date,
  TimeOfDay,
  DateAndTime,
  String,   // bytes of UTF-8
  Wstring,  // two bytes for each character, UTF-16
  Char,
  Wchar,
};
inline constexpr std::size_t kElementaryCount = static_cast<std::size_t>(Elementary::Wchar) + 1;

// "DINT", "TIME_OF_DAY".
[[nodiscard]] std::string_view name_of(Elementary type) noexcept;
// Finds a type by any of its names, in any case: "dint", "TOD", "TIME_OF_DAY", "LTIME".
[[nodiscard]] std::optional<Elementary> elementary_named(std::string_view name) noexcept;

// Returns the width of one value in bits; BOOL 1, times 64, STRING and WSTRING 0.
[[nodiscard]] unsigned bits_of(Elementary type) noexcept;

[[nodiscard]] bool is_signed_int(Elementary type) noexcept;    // SINT INT DINT LINT
[[nodiscard]] bool is_unsigned_int(Elementary type) noexcept;  // USINT UINT UDINT ULINT
[[nodiscard]] bool is_int(Elementary type) noexcept;           // ANY_INT
[[nodiscard]] bool is_real(Elementary type) noexcept;          // ANY_REAL
[[nodiscard]] bool is_num(Elementary type) noexcept;           // ANY_NUM
[[nodiscard]] bool is_bit(Elementary type) noexcept;           // ANY_BIT, including BOOL
[[nodiscard]] bool is_date(Elementary type) noexcept;          // ANY_DATE: DATE TIME_OF_DAY DATE_AND_TIME
[[nodiscard]] bool is_text(Elementary type) noexcept;          // ANY_STRING: STRING WSTRING
[[nodiscard]] bool is_character(Elementary type) noexcept;     // ANY_CHAR: CHAR WCHAR

// Returns whether every value of `from` can be used as a `to` without a conversion function: equal types, integers and
// reals into wider ones (SINT -> INT -> DINT -> LINT, USINT -> UINT -> ..., unsigned into wider signed, integers of up
// to 16 bits into REAL, of up to 32 into LREAL, REAL -> LREAL), BYTE -> WORD -> DWORD -> LWORD. BOOL never converts.
[[nodiscard]] bool widens(Elementary from, Elementary to) noexcept;

// As widens(), with the rules of CODESYS: integers and bit strings into each other if no bit is lost, both into reals,
// reals into each other.
[[nodiscard]] bool converts_in_codesys(Elementary from, Elementary to) noexcept;

// Names are compared without case, in ASCII. "MotorOn" -> "MOTORON"
[[nodiscard]] std::string upper(std::string_view name);
[[nodiscard]] bool same_name(std::string_view a, std::string_view b) noexcept;

}  // namespace indurop::plc
