// SPDX-License-Identifier: Apache-2.0
// A temporary folder of this run. Not real-time safe.

#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace indurop::base {

// What to tell the user if it could not be created.
inline constexpr const char* kNoTemporaryFolder = "cannot create a temporary folder; is TMPDIR a folder with room?";

// Removes the folder with its contents in the destructor.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code error;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
    std::string name = (parent / "indurop-XXXXXX").string();
    path_ = error || ::mkdtemp(name.data()) == nullptr ? "" : name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code error;
    if (!path_.empty()) {
      std::filesystem::remove_all(path_, error);
    }
  }
  // Empty: it could not be created.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace indurop::base
