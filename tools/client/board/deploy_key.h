// SPDX-License-Identifier: Apache-2.0
// The key that signs deployments and commands to boards.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "core/base/problem.h"
#include "tools/client/messages.h"

namespace indurop::tools {

// Reads the private key of the deployer in a folder of keys (indurop keys init). Without a folder there is none, and a
// note explains what that means.
Result<std::string, base::Problem> read_deploy_key(Messages& messages, const std::filesystem::path& folder);

}  // namespace indurop::tools
