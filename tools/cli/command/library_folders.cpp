// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/library_folders.h"

#include <system_error>

namespace indurop::tools {

namespace fs = std::filesystem;

std::vector<fs::path> library_folders(const fs::path& prefix) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const char* library : {"lib", "lib64"}) {
    found.push_back(prefix / library);
    for (const auto& entry : fs::directory_iterator(prefix / library, error)) {
      if (entry.is_directory(error)) {
        found.push_back(entry.path());
      }
    }
  }
  return found;
}

}  // namespace indurop::tools
