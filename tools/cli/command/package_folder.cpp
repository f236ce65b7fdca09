// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/package_folder.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "tools/cli/command/library_folders.h"

namespace indurop::tools {

namespace fs = std::filesystem;

fs::path package_folder(const fs::path& programs) {
  constexpr const char* kFile = "InduRoPConfig.cmake";
  const fs::path prefix = programs.parent_path();
  std::vector<fs::path> places{prefix};
  for (const fs::path& library : library_folders(prefix)) {
    places.push_back(library / "cmake/InduRoP");
  }
  std::error_code error;
  const auto found = std::find_if(places.begin(), places.end(),
                                  [&](const fs::path& place) { return fs::exists(place / kFile, error); });
  return found == places.end() ? fs::path{} : *found;
}

}  // namespace indurop::tools
