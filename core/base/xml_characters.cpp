// SPDX-License-Identifier: Apache-2.0
#include "core/base/xml_characters.h"

#include <charconv>
#include <cstdint>

#include "core/base/text.h"

namespace indurop::base {
namespace {

bool is_character(std::string_view number) {
  const bool hex = number.starts_with('x');
  if (hex) {
    number.remove_prefix(1);
  }
  std::uint32_t code = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), code, hex ? 16 : 10);
  if (error != std::errc{} || end != number.data() + number.size()) {
    return false;
  }
  return code == 9 || code == 10 || code == 13 || (code >= 0x20 && code < 0xD800) ||
         (code >= 0xE000 && code < 0x110000 && code != 0xFFFE && code != 0xFFFF);
}

}  // namespace

std::string mistake_of_reference(std::string_view text) {
  constexpr std::size_t kLongest = 12;
  const std::string_view rest = text.substr(0, kLongest);
  const std::size_t end = rest.find(';');
  const std::string_view reference = end == std::string_view::npos ? std::string_view{} : rest.substr(0, end);
  for (const std::string_view known : {"amp", "lt", "gt", "quot", "apos"}) {
    if (reference == known) {
      return {};
    }
  }
  if (!reference.starts_with('#')) {
    return "'&' begins no known entity; as text write &amp;";
  }
  return is_character(reference.substr(1))
             ? std::string{}
             : in_quotes("&" + std::string(reference) + ";") + " is not a character XML allows; remove it";
}

}  // namespace indurop::base
