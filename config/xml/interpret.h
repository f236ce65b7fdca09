// SPDX-License-Identifier: Apache-2.0
// What the elements of a module.xml or of a manifest mean.

#pragma once

#include <vector>

#include "base/xml_element.h"
#include "config/model/config.h"

namespace indurop::config {

// Reads what the elements below `root` mean into `config` (whose `file` is set) and appends what is wrong.
void interpret(const base::Element& root, Config& config, std::vector<base::Diagnostic>& diagnostics);
struct Plant;
void interpret_plant(const base::Element& root, Plant& plant, std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::config
