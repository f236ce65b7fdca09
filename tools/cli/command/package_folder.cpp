// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/package_folder.h"

#include <algorithm>
#include <system_error>
#include <vector>

namespace indurop::tools {

namespace fs = std::filesystem;

fs::path package_folder(const fs::path& programs) {
  constexpr const char* kFile = "InduRoPConfig.cmake";
  const fs::path prefix = programs.parent_path();
  std::vector<fs::path> places{prefix};
  std::error_code error;
  for (const char* library : {"lib", "lib64"}) {
    places.push_back(prefix / library / "cmake/InduRoP");
    for (const auto& entry : fs::directory_iterator(prefix / library, error)) {
      places.push_back(entry.path() / "cmake/InduRoP");  // lib/x86_64-linux-gnu
    }
  }
  const auto found = std::find_if(places.begin(), places.end(),
                                  [&](const fs::path& place) { return fs::exists(place / kFile, error); });
  return found == places.end() ? fs::path{} : *found;
}

}  // namespace indurop::tools
