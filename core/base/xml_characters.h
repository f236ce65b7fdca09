// SPDX-License-Identifier: Apache-2.0
// The characters allowed in an XML document.

#pragma once

#include <string>
#include <string_view>

namespace indurop::base {

constexpr bool is_xml_space(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
constexpr bool begins_xml_name(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' ||
         static_cast<unsigned char>(c) >= 0x80;
}
constexpr bool continues_xml_name(char c) noexcept {
  return begins_xml_name(c) || (c >= '0' && c <= '9') || c == '.' || c == '-';
}

// Returns what is wrong with the reference that begins with the '&' before `text`; empty: nothing.
[[nodiscard]] std::string mistake_of_reference(std::string_view text);

}  // namespace indurop::base
