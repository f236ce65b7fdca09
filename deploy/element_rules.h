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

#include "deploy/element.h"
#include "deploy/report.h"

namespace indurop::deploy {

using FirstPlaces = std::map<std::string, Place, std::less<>>;  // of elements, by name

bool is_known(const Element& child, const Element& container, const std::vector<std::string>& known, Report& report);
// False if `child` has a namesake before it; `container` as in "in this <module>".
bool is_first(const Element& child, const std::string& container, FirstPlaces& places, Report& report);

bool is_leaf(const Element& element, Report& report);
void check_no_text(const Element& container, Report& report);
void check_attributes(const Element& element, const std::vector<std::string>& known, Report& report);
// As check_attributes, but editors may add what leads them to the schema.
void check_root_attributes(const Element& root, const std::vector<std::string>& known, Report& report);

// The attribute, or nullptr; its value may be empty.
const Attribute* find_attribute(const Element& element, std::string_view name);
// An attribute that must be there and not empty; nullptr after an error that shows `example`.
const Attribute* need_attribute(const Element& element, const char* name, std::string_view example, Report& report);

// The text of an element that must have some and has no attributes.
std::optional<std::string> text_of(const Element& element, std::string_view example, Report& report);
std::optional<Nanos> duration_of(const Element& element, bool zero_allowed, Report& report);
// A file's or folder's name in one line.
bool is_file_name(const Element& element, const std::string& text, Report& report);
int read_core(const Element& element, Report& report);

// The number of the element's text among `words`; empty after an error if it is none of them.
std::optional<std::size_t> choose(const Element& element, const std::vector<std::string>& words, Report& report);

void sort_by_place(std::vector<Diagnostic>& diagnostics);

}  // namespace indurop::deploy
