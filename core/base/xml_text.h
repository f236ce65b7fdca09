// SPDX-License-Identifier: Apache-2.0
// Text as the content of an XML element or of a quoted attribute.

#pragma once

#include <string>
#include <string_view>

namespace indurop::base {

inline std::string xml_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace indurop::base
