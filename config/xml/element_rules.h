// SPDX-License-Identifier: Apache-2.0
// What holds for elements whatever they are called: known children, none twice, values, attributes. Each rule reports
// what is wrong and how to write it.

#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/duration.h"
#include "base/xml_element.h"
#include "config/model/config.h"

namespace indurop::config {

using FirstPlaces = std::map<std::string, base::SourcePlace, std::less<>>;  // of elements, by name

bool is_known(const base::Element& child, const base::Element& container, const std::vector<std::string>& known,
              base::Diagnostics& report);
// False if `child` has a namesake before it; `container` as in "in this <module>".
bool is_first(const base::Element& child, const std::string& container, FirstPlaces& places, base::Diagnostics& report);

bool is_leaf(const base::Element& element, base::Diagnostics& report);
void check_no_text(const base::Element& container, base::Diagnostics& report);
void check_attributes(const base::Element& element, const std::vector<std::string>& known, base::Diagnostics& report);
// As check_attributes, but editors may add what leads them to the schema.
void check_root_attributes(const base::Element& root, const std::vector<std::string>& known, base::Diagnostics& report);

// The attribute, or nullptr; its value may be empty.
const base::Attribute* find_attribute(const base::Element& element, std::string_view name);
// An attribute that must be there and not empty; nullptr after an error that shows `example`.
const base::Attribute* need_attribute(const base::Element& element, const char* name, std::string_view example,
                                      base::Diagnostics& report);

// The text of an element that must have some and has no attributes.
std::optional<std::string> text_of(const base::Element& element, std::string_view example, base::Diagnostics& report);
std::optional<base::Nanos> duration_of(const base::Element& element, bool zero_allowed, base::Diagnostics& report);
// A file's or folder's name in one line.
bool is_file_name(const base::Element& element, const std::string& text, base::Diagnostics& report);
int read_core(const base::Element& element, base::Diagnostics& report);

// The number of the element's text among `words`; empty after an error if it is none of them.
std::optional<std::size_t> choose(const base::Element& element, const std::vector<std::string>& words,
                                  base::Diagnostics& report);

}  // namespace indurop::config
