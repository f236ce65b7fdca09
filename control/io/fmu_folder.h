// SPDX-License-Identifier: Apache-2.0
// An unpacked FMU in a temporary folder, which ends with the object. A folder whose process was killed is removed when
// the next FMU of this user is unpacked: a lock in it says whether its process lives.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "core/base/descriptor.h"

namespace indurop::io {

class FmuFolder {
 public:
  // Not real-time safe. Errors: what is wrong, and what to do.
  static Result<FmuFolder, std::string> unpack(const std::filesystem::path& fmu);
  FmuFolder(FmuFolder&&) noexcept = default;
  FmuFolder& operator=(FmuFolder&&) = delete;
  ~FmuFolder();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  FmuFolder(std::filesystem::path path, base::Descriptor lock) : path_(std::move(path)), lock_(std::move(lock)) {}

  std::filesystem::path path_;
  base::Descriptor lock_;
};

}  // namespace indurop::io
