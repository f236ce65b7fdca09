// SPDX-License-Identifier: Apache-2.0
// Finds line and column of every tag, attribute and text of an XML document, which the XML library does not report, and
// the mistakes it accepts. Knows nothing of what elements mean. Any bytes are accepted.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/source_place.h"

namespace indurop::base {

// The form a document must have, and how much of it is read.
struct XmlRules {
  const char* name = "";  // for messages: a <name> is <form>, no <purpose> needs that
  const char* form = "";
  const char* purpose = "";
  std::size_t max_bytes = 0;
  std::size_t max_depth = 0;        // less than 100
  std::size_t max_attributes = 32;  // of one tag; each is compared with all before it
  // For files written by programs: what the XML library accepts is no mistake, and texts and values keep the white
  // space around them. Where the scanner cannot follow, places are lines only.
  bool tolerant = false;
};

struct AttributePlaces {
  std::string_view name;
  SourcePlace place;  // of the name
  SourcePlace value;  // of the first character between the quotes
};

struct TagPlaces {
  std::string_view name;
  SourcePlace place;  // of '<'
  SourcePlace text;   // where the text begins, with the white space before it if that is kept
  std::vector<AttributePlaces> attributes;
};

struct XmlMistake {
  SourcePlace place;
  std::string text;
};

// Views point into the text. Columns count characters from 1, as editors do.
struct XmlPlaces {
  std::vector<TagPlaces> tags;          // start tags in document order
  std::vector<XmlMistake> mistakes;     // what makes the text not well-formed or unacceptable; nothing is read after a
                                        // mistake that leaves it unclear how to go on
  std::optional<std::size_t> unclosed;  // tolerant: the tag that is still open where the text ends
};

[[nodiscard]] XmlPlaces find_places(std::string_view xml, const XmlRules& rules);

}  // namespace indurop::base
