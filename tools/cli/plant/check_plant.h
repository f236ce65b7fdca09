// SPDX-License-Identifier: Apache-2.0
// indurop check on the manifest of a plant: its boards, and the variables sent between them.

#pragma once

#include <string>

#include "config/check/check.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

// ", 2 modules without INDUROP_STATE" for a summary; empty: all declare what they keep.
std::string without_state(std::size_t modules);

// Returns the exit code.
int check_plant_file(Context& context, const std::string& file, const config::CheckOptions& options);

}  // namespace indurop::tools
