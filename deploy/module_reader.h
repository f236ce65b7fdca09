// SPDX-License-Identifier: Apache-2.0
// What the elements below one <module> mean.

#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "deploy/element.h"
#include "deploy/report.h"

namespace indurop::deploy {

// Checks shared by root and module elements.
bool is_leaf(const Element& element, Report& report);
void check_attributes(const Element& element, const std::vector<std::string>& known, Report& report);
void check_no_text(const Element& container, Report& report);
int read_core(const Element& element, Report& report);

// What a <module> was given, to judge whether that is what its kind of module needs.
struct Given {
  std::map<std::string, Place, std::less<>> elements;  // by name, where the first one is
  std::set<std::string, std::less<>> misspelt;         // names that unknown elements probably mean
  bool type = false;                                   // <moduletype> is there and valid
  bool operation = false;                              // <operationtype> likewise
  [[nodiscard]] bool has(const char* name) const { return elements.find(name) != elements.end(); }
};
// Elements missing, elements without effect, times that contradict each other. Clears values without effect.
void check_rules(Module& module, const Given& given, Report& report);

// A module as far as it can be read; `folder` is where relative file names start. Its name is still empty if it has
// no <name>.
Module read_module(const Element& element, const std::filesystem::path& folder, Report& report);

}  // namespace indurop::deploy
