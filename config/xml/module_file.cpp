// SPDX-License-Identifier: Apache-2.0
#include "config/xml/module_file.h"

#include <string_view>
#include <system_error>
#include <vector>

#include "core/base/program_folder.h"

namespace indurop::config {
namespace {

namespace fs = std::filesystem;

// Returns lib/, lib64/ and lib/x86_64-linux-gnu/ next to bin/ in the installation or build tree of this program.
std::vector<fs::path> library_folders() {
  const fs::path prefix = base::program_folder().parent_path();
  std::vector<fs::path> folders;
  for (const char* name : {"lib", "lib64"}) {
    folders.push_back(prefix / name);
  }
  std::error_code error;
  for (fs::directory_iterator entry(prefix / "lib", error), end; entry != end; entry.increment(error)) {
    constexpr std::string_view kTriplet = "-linux-gnu";
    if (entry->path().filename().string().find(kTriplet) != std::string::npos) {
      folders.push_back(entry->path());
    }
  }
  return folders;
}

// Returns an empty path if it is not in the folder.
fs::path find_in(const fs::path& folder, const std::string& text) {
  for (const std::string& name : {text, text + ".so", "lib" + text + ".so", text + ".exe"}) {
    std::error_code error;
    if (fs::is_regular_file(folder / name, error)) {
      return folder / name;
    }
  }
  return {};
}

}  // namespace

fs::path module_file(const fs::path& folder, const std::string& text) {
  const fs::path plain = (folder / text).lexically_normal();
  std::error_code error;
  if (text.find('/') != std::string::npos || fs::exists(plain, error)) {
    return plain;
  }
  fs::path found = find_in(folder, text);
  for (const fs::path& library : found.empty() ? library_folders() : std::vector<fs::path>{}) {
    found = found.empty() ? find_in(library, text) : found;
  }
  return found.empty() ? plain : found.lexically_normal();
}

}  // namespace indurop::config
