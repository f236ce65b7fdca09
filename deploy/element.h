// SPDX-License-Identifier: Apache-2.0
// An XML element as plain data with places, so that what the elements mean is kept apart from how XML is read.

#pragma once

#include <string>
#include <vector>

#include "deploy/config.h"

namespace indurop::deploy {

struct Attribute {
  std::string name;
  std::string value;
  Place place;        // of the name
  Place value_place;  // of the first character between the quotes
};

struct Element {
  std::string name;
  Place place;       // of '<'
  std::string text;  // own text without that of children, white space around it removed
  Place text_place;  // of its first character; that of the element if it has no text
  std::vector<Attribute> attributes;
  std::vector<Element> children;
};

// Reads what the elements below `root` mean into `config` (whose `file` is set) and appends what is wrong.
void interpret(const Element& root, Config& config, std::vector<Diagnostic>& diagnostics);
struct Plant;
void interpret_plant(const Element& root, Plant& plant, std::vector<Diagnostic>& diagnostics);

}  // namespace indurop::deploy
