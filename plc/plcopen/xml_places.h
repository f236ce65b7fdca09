// SPDX-License-Identifier: Apache-2.0
// Line and column of every start tag of an XML text and of the text inside, which the XML library does not tell.
// Any bytes are accepted: of a text that is not well-formed the places before the first mistake are right.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::plc::plcopen {

struct TagPlace {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::uint32_t text_line = 0;  // where the first text of the element begins; 0: it has none
  std::uint32_t text_column = 0;
};

struct TagPlaces {
  std::vector<TagPlace> tags;  // in the order of the text
  std::size_t depth = 0;       // of the deepest element
  std::uint32_t deepest_line = 0;
  std::string open;  // an element that is not closed at the end of the text, if there is one
  std::uint32_t open_line = 0;
};

[[nodiscard]] TagPlaces find_tags(std::string_view xml);

}  // namespace indurop::plc::plcopen
