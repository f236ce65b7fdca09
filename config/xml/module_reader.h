// SPDX-License-Identifier: Apache-2.0
// What the elements below one <module> mean.

#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "config/model/config.h"
#include "config/xml/element_rules.h"

namespace indurop::config {

// What a <module> was given, to judge whether that is what its kind of module needs.
struct Given {
  FirstPlaces elements;                         // by name, where the first one is
  std::set<std::string, std::less<>> misspelt;  // names that unknown elements probably mean
  bool type = false;                            // <moduletype> is there and valid
  bool operation = false;                       // <operationtype> likewise
  [[nodiscard]] bool has(const char* name) const { return elements.find(name) != elements.end(); }
};
// Elements missing, elements without effect, times that contradict each other. Clears values without effect.
void check_rules(config::Module& module, const Given& given, base::Diagnostics& report);

// A module as far as it can be read; `folder` is where relative file names start. Its name is still empty if it has
// no <name>.
config::Module read_module(const base::Element& element, const std::filesystem::path& folder,
                           base::Diagnostics& report);

}  // namespace indurop::config
