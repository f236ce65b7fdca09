// SPDX-License-Identifier: Apache-2.0
// Converts the elements of a module.xml or of a manifest into a configuration.

#pragma once

#include <vector>

#include "config/model/config.h"
#include "core/base/xml_element.h"

namespace indurop::config {

// Converts the elements below `root` into `config` (whose `file` is set) and appends the errors.
void interpret(const base::Element& root, Config& config, std::vector<base::Diagnostic>& diagnostics);
struct Plant;
void interpret_plant(const base::Element& root, Plant& plant, std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::config
