// SPDX-License-Identifier: Apache-2.0
// Names of plants and boards as parts of DDS topic names, the same for the mirror and for the rights to topics.

#pragma once

#include <string>
#include <string_view>

namespace indurop::schema {

// Topic names may hold no '-': "_m" stands for it, "__" for '_', so that different names stay different.
inline std::string topic_part(std::string_view name) {
  std::string part;
  for (const char c : name) {
    if (c == '-') {
      part += "_m";
    } else if (c == '_') {
      part += "__";
    } else {
      part += c;
    }
  }
  return part;
}

}  // namespace indurop::schema
