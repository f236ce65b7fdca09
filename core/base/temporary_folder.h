// SPDX-License-Identifier: Apache-2.0
// A temporary folder of this run. Not real-time safe.

#pragma once

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace indurop::base {

// Removes the folder with its contents in the destructor.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code error;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
    std::string name = (parent / "indurop-XXXXXX").string();
    if (!error && ::mkdtemp(name.data()) != nullptr) {
      path_ = name;
      return;
    }
    const std::string reason = (error ? error : std::error_code(errno, std::generic_category())).message();
    const std::string place = error ? "" : " in " + parent.string();
    problem_ = "cannot create a temporary folder" + place + ": " + reason +
               "; is TMPDIR a folder with room, to which this user may write?";
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
  // Why it could not be created, and what to do.
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

 private:
  std::filesystem::path path_;
  std::string problem_;
};

}  // namespace indurop::base
