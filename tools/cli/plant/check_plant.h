// SPDX-License-Identifier: Apache-2.0
// indurop check on the manifest of a plant: its boards, and the variables sent between them.

#pragma once

#include <string>

#include "config/check/check.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Returns the exit code.
int check_plant_file(Context& context, const std::string& file, const config::CheckOptions& options);

}  // namespace indurop::tools
