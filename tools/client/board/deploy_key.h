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

// The key that signs commands, and, if it is not a deployer's, the certificate that says whose it is.
struct CommandKey {
  std::string key;
  std::string certificate;
};
// Reads the key for commands in a folder of keys: that of a user (indurop keys add --user) or of a deployer.
Result<CommandKey, base::Problem> read_command_key(Messages& messages, const std::filesystem::path& folder);
// Returns the signature of a command's text; empty without a key.
std::string command_signature(const CommandKey& key, const std::string& text);

}  // namespace indurop::tools
