// SPDX-License-Identifier: Apache-2.0
// Work frames of a robot module's jobs, for those who show robots and know nothing of their files.

#pragma once

#include <string>
#include <vector>

#include "config/model/config.h"

namespace indurop::tools {

// Their names; none if its files cannot be read.
std::vector<std::string> work_frames_of(const config::Config& config, const std::string& module);

}  // namespace indurop::tools
