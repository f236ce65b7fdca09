// SPDX-License-Identifier: Apache-2.0
// Rules that hold for all elements: known children, no duplicates, values, attributes. Each rule reports the error and
// how to correct it.

#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/model/config.h"
#include "core/base/diagnostics.h"
#include "core/base/duration.h"
#include "core/base/xml_element.h"

namespace indurop::config {

using FirstPlaces = std::map<std::string, base::SourcePlace, std::less<>>;  // first place of each element, by name

bool is_known(const base::Element& child, const base::Element& container, const std::vector<std::string>& known,
              base::Diagnostics& report);
// Returns false if an element with the same name came before `child`; `container` as in "in this <module>".
bool is_first(const base::Element& child, const std::string& container, FirstPlaces& places, base::Diagnostics& report);

bool is_leaf(const base::Element& element, base::Diagnostics& report);
void check_no_text(const base::Element& container, base::Diagnostics& report);
void check_attributes(const base::Element& element, const std::vector<std::string>& known, base::Diagnostics& report);
// Like check_attributes, but allows the attributes with which editors refer to the schema.
void check_root_attributes(const base::Element& root, const std::vector<std::string>& known, base::Diagnostics& report);

// Returns the attribute, or nullptr; its value may be empty.
const base::Attribute* find_attribute(const base::Element& element, std::string_view name);
// Returns an attribute that must be present and not empty; nullptr after an error that shows `example`.
const base::Attribute* need_attribute(const base::Element& element, const char* name, std::string_view example,
                                      base::Diagnostics& report);

// Returns the text of an element that must have some and must have no attributes.
std::optional<std::string> text_of(const base::Element& element, std::string_view example, base::Diagnostics& report);
std::optional<base::Nanos> duration_of(const base::Element& element, bool zero_allowed, base::Diagnostics& report);
// Checks that the text is a file or folder name on one line.
bool is_file_name(const base::Element& element, const std::string& text, base::Diagnostics& report);
int read_core(const base::Element& element, base::Diagnostics& report);

// Returns the index of the element's text in `words`; nothing after an error if it is none of them.
std::optional<std::size_t> choose(const base::Element& element, const std::vector<std::string>& words,
                                  base::Diagnostics& report);

}  // namespace indurop::config
