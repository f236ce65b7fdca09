// SPDX-License-Identifier: Apache-2.0
// Work frames in the jobs of a robot module, for programs that show robots without reading their files.

#pragma once

#include <string>
#include <vector>

#include "config/model/config.h"

namespace indurop::tools {

// Returns their names; none if the files cannot be read.
std::vector<std::string> work_frames_of(const config::Config& config, const std::string& module);

}  // namespace indurop::tools
