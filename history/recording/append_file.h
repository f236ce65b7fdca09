// SPDX-License-Identifier: Apache-2.0
// A new file that only grows, by whole portions: a portion that cannot be written leaves no bytes in it.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <future>

#include "core/base/descriptor.h"
#include "core/base/problem.h"
#include "history/recording/records.h"

namespace indurop::recording {

class AppendFile {
 public:
  // Errors: a file of this name exists already; errors of the operating system.
  static Result<AppendFile, base::Problem> create(const std::filesystem::path& path);

  // After an error (usually a full disk) the file is as before and the call may be repeated.
  Result<void, base::Problem> append(View bytes);
  // Begins to bring the bytes to the disk, where they survive a loss of power; does nothing while the last time goes
  // on. Errors of the last time.
  Result<void, base::Problem> begin_sync();
  // Returns when the bytes are on the disk. Errors as above; the file is closed then too.
  Result<void, base::Problem> close();

  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  // The CRC of all bytes.
  [[nodiscard]] std::uint32_t crc() const noexcept { return crc_; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  AppendFile(std::filesystem::path path, base::Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}

  std::filesystem::path path_;
  base::Descriptor file_;
  std::future<int> syncing_;  // an errno, or 0; ends before the file is closed
  std::uint64_t size_ = 0;
  std::uint32_t crc_ = 0;
};

}  // namespace indurop::recording
