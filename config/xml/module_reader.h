// SPDX-License-Identifier: Apache-2.0
// Reads the elements below one <module>.

#pragma once

#include <set>
#include <string>
#include <vector>

#include "config/model/config.h"
#include "config/xml/element_rules.h"
#include "core/base/diagnostics.h"

namespace indurop::config {

// The elements that a <module> has, to check them against what its kind of module needs.
struct Given {
  FirstPlaces elements;                         // by name, place of the first one
  std::set<std::string, std::less<>> misspelt;  // known names that unknown elements probably misspell
  bool type = false;                            // <moduletype> is there and valid
  bool operation = false;                       // <operationtype> is there and valid
  [[nodiscard]] bool has(const char* name) const { return elements.find(name) != elements.end(); }
};
// Reports missing elements, elements without effect, and contradictory times. Clears values without effect.
void check_rules(config::Module& module, const Given& given, base::Diagnostics& report);

// Reads a module as far as possible; relative file names start at `folder`. Its name stays empty if it has no <name>.
config::Module read_module(const base::Element& element, const std::filesystem::path& folder,
                           base::Diagnostics& report);

}  // namespace indurop::config
