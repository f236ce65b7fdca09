// SPDX-License-Identifier: Apache-2.0
// An option for patterns over names: "press::*,table::count".

#pragma once

#include <string>
#include <vector>

#include "core/base/options.h"

namespace indurop::tools {

// Appends the patterns, with commas between them, to `to`; a wrong one is a usage error.
void add_pattern_option(base::Options& verb, const char* name, std::vector<std::string>& to, const char* help);

}  // namespace indurop::tools
