// SPDX-License-Identifier: Apache-2.0
// Conversions of WSTRING, CHAR and WCHAR. A STRING is UTF-8, a WSTRING UTF-16; a byte that is not valid UTF-8 becomes
// the character with its number. A CHAR is one byte, as in a STRING. Real-time safe.

#pragma once

#include <indurop/plc/text_read.h>
#include <indurop/plc/text_write.h>
#include <indurop/plc/types.h>
#include <indurop/plc/unicode.h>

#include <concepts>
#include <cstddef>
#include <string_view>

namespace indurop::iec {

// A text never has more two-byte characters than bytes of UTF-8.
template <NarrowText T>
WideText<detail::kTextSize<T>> to_wstring(const T& in) noexcept {
  WideText<detail::kTextSize<T>> out;
  std::size_t used = 0;
  detail::each_wide(in.view(), [&](char16_t one) { out.data[used++] = one; });
  return out;
}
template <BroadText T>
T to_wstring(const T& in) noexcept {
  return in;
}

template <BroadText T>
auto to_string(const T& in) noexcept {
  String<3 * (detail::kTextSize<T> - 1)> out;
  std::size_t used = 0;
  detail::each_byte(in.view(), [&](char one) { out.data[used++] = one; });
  return out;
}

inline String<1> to_string(char8_t one) noexcept {
  const auto byte = static_cast<char>(one);
  return std::string_view(&byte, 1);
}
inline String<3> to_string(char16_t one) noexcept {
  return to_string(WideText<2>(std::u16string_view(&one, 1)));
}
inline WideText<2> to_wstring(char8_t one) noexcept {
  const auto wide = static_cast<char16_t>(one);
  return std::u16string_view(&wide, 1);
}
inline WideText<2> to_wstring(char16_t one) noexcept {
  return std::u16string_view(&one, 1);
}
template <Scalar T>
auto to_wstring(T value) noexcept {
  return to_wstring(to_string(value));
}
template <BitString T>
WString<20> to_wliteral(T value) noexcept {
  return to_wstring(to_literal(value));
}

// WSTRING_TO_X is to<X>(text); WSTRING_TO_WCHAR is its first character, 0 if there is none.
template <Scalar To, BroadText From>
To to(const From& text) noexcept {
  if constexpr (std::same_as<To, char8_t> || std::same_as<To, char16_t>) {
    return text.size() == 0 ? To{} : static_cast<To>(text.view()[0]);
  } else {
    return to<To>(to_string(text));
  }
}

}  // namespace indurop::iec
