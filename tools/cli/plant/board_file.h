// SPDX-License-Identifier: Apache-2.0
// Files that agents provide by name, such as black boxes.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "deploy/link/deploy_link.h"
#include "tools/client/failure.h"

namespace indurop::tools {

struct BoardFile {
  std::string board;
  std::uint64_t agent = 0;
  std::string blob;  // the agent's name for it
  std::uint64_t bytes = 0;
};

// Writes it to `to`, which is replaced. `self`: session of the link. Fails if the board stops answering, has deleted it
// meanwhile, or the user interrupts.
Result<void, Failure> fetch_file(deploy::DeployLink& link, std::uint64_t self, const BoardFile& file,
                                 const std::filesystem::path& to);

}  // namespace indurop::tools
