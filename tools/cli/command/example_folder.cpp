// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/example_folder.h"

#include <system_error>

#include "tools/cli/command/library_folders.h"

namespace indurop::tools {

namespace fs = std::filesystem;

fs::path example_folder(const fs::path& programs, const std::string& name) {
  std::error_code error;
  const fs::path prefix = programs.parent_path();
  if (const fs::path built = prefix / "examples" / name; fs::exists(built / "demo.sh", error)) {
    return built;
  }
  for (const fs::path& library : library_folders(prefix)) {
    if (fs::path installed = library / "indurop/examples" / name; fs::exists(installed / "demo.sh", error)) {
      return installed;
    }
  }
  return {};
}

}  // namespace indurop::tools
