// SPDX-License-Identifier: Apache-2.0
// An argument of irp::printf together with its type, so that a wrong conversion in the format can be corrected instead
// of crashing a real-time thread.

#pragma once

#include <indurop/string.h>

#include <concepts>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace indurop::detail {

struct PrintArgument {  // NOLINT(cppcoreguidelines-pro-type-member-init): a union has one value
  enum class Kind : std::uint32_t { Signed, Unsigned, Real, Text, Pointer };
  Kind kind = Kind::Signed;
  std::uint32_t size = 0;  // bytes of an integer after C's promotion; characters of a text
  union {
    std::int64_t as_signed = 0;
    std::uint64_t as_unsigned;
    double as_real;
    const char* as_text;
    const void* as_pointer;
  };
};

inline PrintArgument text_argument(std::string_view text) noexcept {
  PrintArgument result;
  result.kind = PrintArgument::Kind::Text;
  result.size = static_cast<std::uint32_t>(text.size());
  result.as_text = text.data();
  return result;
}

template <class T>
PrintArgument print_argument(const T& value) noexcept {
  using Plain = std::decay_t<T>;
  PrintArgument result;
  if constexpr (std::is_enum_v<Plain>) {
    return print_argument(static_cast<std::underlying_type_t<Plain>>(value));
  } else if constexpr (std::floating_point<Plain>) {
    result.kind = PrintArgument::Kind::Real;
    result.as_real = static_cast<double>(value);
  } else if constexpr (std::integral<Plain>) {
    result.size = sizeof(Plain) < sizeof(int) ? sizeof(int) : sizeof(Plain);
    if constexpr (std::signed_integral<Plain> || sizeof(Plain) < sizeof(int)) {
      result.as_signed = value;
    } else {
      result.kind = PrintArgument::Kind::Unsigned;
      result.as_unsigned = value;
    }
  } else if constexpr (std::is_same_v<Plain, const char*> || std::is_same_v<Plain, char*>) {
    const char* text = value;
    return text_argument(text == nullptr ? "(null)" : text);
  } else if constexpr (std::is_convertible_v<const T&, std::string_view>) {
    return text_argument(value);
  } else if constexpr ((std::is_pointer_v<Plain> && std::is_object_v<std::remove_pointer_t<Plain>>) ||
                       std::is_same_v<Plain, void*> || std::is_same_v<Plain, const void*> ||
                       std::is_null_pointer_v<Plain>) {
    result.kind = PrintArgument::Kind::Pointer;
    result.as_pointer = value;
  } else {
    static_assert(std::is_void_v<T>, "irp::printf prints numbers, text and pointers: give it the members one by one");
  }
  return result;
}

}  // namespace indurop::detail

extern "C" {
// See irp::printf.
int indurop_print(const char* format, const indurop::detail::PrintArgument* arguments, std::uint32_t count) noexcept;
}
