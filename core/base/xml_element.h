// SPDX-License-Identifier: Apache-2.0
// An XML element as plain data with places, so that the meaning of elements is kept apart from how XML is read.

#pragma once

#include <string>
#include <vector>

#include "core/base/source_place.h"

namespace indurop::base {

struct Attribute {
  std::string name;
  std::string value;
  SourcePlace place;        // of the name
  SourcePlace value_place;  // of the first character between the quotes
};

struct Element {
  std::string name;
  SourcePlace place;       // of '<'
  std::string text;        // without that of children and without white space around it
  SourcePlace text_place;  // of its first character; that of the element if it has no text
  std::vector<Attribute> attributes;
  std::vector<Element> children;
};

}  // namespace indurop::base
