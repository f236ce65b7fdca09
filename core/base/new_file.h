// SPDX-License-Identifier: Apache-2.0
// Writes a file part by part and tells why that failed, which streams do not. After a crash a part of it may be there;
// replace_file() writes all or nothing.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string_view>

#include "core/base/descriptor.h"
#include "core/base/file_problem.h"

namespace indurop::base {

class NewFile {
 public:
  // Creates the file, or empties it.
  explicit NewFile(const std::filesystem::path& path) noexcept;
  // Returns false if anything failed.
  [[nodiscard]] bool good() const noexcept { return error_ == 0; }
  // Returns good().
  bool write(std::string_view bytes) noexcept;
  // Closes the file. Returns the first error of all. Errors: System.
  Result<void, FileProblem> close();

 private:
  Descriptor file_;
  int error_ = 0;  // errno
};

}  // namespace indurop::base
