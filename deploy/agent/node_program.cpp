// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/node_program.h"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

#include "core/base/program_folder.h"

namespace indurop::deploy {

int open_node_program() {
  return ::open((base::program_folder() / "indurop-node").c_str(), O_PATH | O_CLOEXEC);
}

std::string node_program_path(int program) {
  const std::string held = "/proc/self/fd/" + std::to_string(program);
  std::error_code error;
  const std::filesystem::path file = std::filesystem::read_symlink(held, error);
  return !error && ::access(file.c_str(), X_OK) == 0 ? file.string() : held;
}

}  // namespace indurop::deploy
