// SPDX-License-Identifier: Apache-2.0
#include "control/plc/model/characters.h"

#include <indurop/plc/unicode.h>

namespace indurop::plc {

std::u16string to_wide(std::string_view utf8) {
  std::u16string out;
  iec::detail::each_wide(utf8, [&](char16_t one) { out += one; });
  return out;
}

std::string to_utf8(std::u16string_view wide) {
  std::string out;
  iec::detail::each_byte(wide, [&](char one) { out += one; });
  return out;
}

std::size_t characters_of(std::string_view utf8, Elementary of) {
  return of == Elementary::Wstring ? to_wide(utf8).size() : utf8.size();
}

std::optional<char16_t> code_of_character(std::string_view utf8, Elementary of) {
  if (of == Elementary::Char) {
    return utf8.size() == 1 ? std::optional<char16_t>(static_cast<unsigned char>(utf8.front())) : std::nullopt;
  }
  const std::u16string wide = to_wide(utf8);
  return wide.size() == 1 ? std::optional(wide.front()) : std::nullopt;
}

}  // namespace indurop::plc
