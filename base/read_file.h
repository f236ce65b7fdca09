// SPDX-License-Identifier: Apache-2.0
// Reading a whole file. What is not an ordinary file is refused, so that nobody waits for a pipe that nobody writes to.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "base/descriptor.h"
#include "base/file_problem.h"

namespace indurop::base {

inline constexpr std::size_t kMostFileBytes = std::size_t{64} << 20U;

struct OpenFile {
  Descriptor file;
  std::uint64_t size = 0;  // when it was opened
};

// Opens an ordinary file for reading. Never blocks, and never opens a device or a pipe, which may have effects.
// Errors: all kinds but TooLarge.
Result<OpenFile, FileProblem> open_file(const std::filesystem::path& path);

// All bytes of an ordinary file that has at most `most` of them. Errors: all kinds.
Result<std::string, FileProblem> read_file(const std::filesystem::path& path, std::size_t most = kMostFileBytes);

}  // namespace indurop::base
