// SPDX-License-Identifier: Apache-2.0
// Line and column of every tag, attribute and text of an XML document, which the XML library does not tell, and the
// mistakes it lets pass. Knows nothing of module.xml. Any bytes are accepted, whatever they contain.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "deploy/config.h"

namespace indurop::deploy {

inline constexpr std::size_t kMaxDepth = 32;

struct AttributePlaces {
  std::string_view name;
  Place place;  // of the name
  Place value;  // of the first character between the quotes
};

struct TagPlaces {
  std::string_view name;
  Place place;  // of '<'
  Place text;   // of the first character of content that is not white space or comment
  std::vector<AttributePlaces> attributes;
};

struct XmlMistake {
  Place place;
  std::string text;
};

// Views point into the text. Columns count characters from 1, as editors do.
struct XmlPlaces {
  std::vector<TagPlaces> tags;       // start tags in document order
  std::vector<XmlMistake> mistakes;  // what makes the text not well-formed or unacceptable; nothing is read after a
                                     // mistake that leaves it unclear how to go on
};

XmlPlaces find_places(std::string_view xml);

}  // namespace indurop::deploy
