// SPDX-License-Identifier: Apache-2.0
#include "core/base/printable.h"

#include "core/base/utf8.h"

namespace indurop::base {

std::string printable(std::string_view text, std::string_view kept) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    const auto lead = static_cast<unsigned char>(text[i]);
    // C1 controls (U+0080..U+009F) are two bytes beginning with C2.
    const bool c1 = length == 2 && lead == 0xC2 && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    const bool control = lead < 0x20 || lead == 0x7F || c1;
    if (length == 0 || (control && kept.find(text[i]) == std::string_view::npos)) {
      out += '?';
      i += length == 0 ? 1 : length;
    } else {
      out.append(text.substr(i, length));
      i += length;
    }
  }
  return out;
}

}  // namespace indurop::base
