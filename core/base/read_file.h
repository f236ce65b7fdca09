// SPDX-License-Identifier: Apache-2.0
// Reads a whole file. Only regular files are accepted, so that no program waits for a pipe without a writer.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/descriptor.h"
#include "core/base/file_problem.h"

namespace indurop::base {

inline constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20U;

struct OpenFile {
  Descriptor file;
  std::uint64_t size = 0;  // when it was opened
};

// Opens a regular file for reading. Never blocks, and never opens a device or a pipe, which may have side effects.
// Errors: all kinds but TooLarge.
Result<OpenFile, FileProblem> open_file(const std::filesystem::path& path);

// Returns all bytes of a regular file with at most `most` bytes. Errors: all kinds.
Result<std::string, FileProblem> read_file(const std::filesystem::path& path, std::size_t most = kMaxFileBytes);

}  // namespace indurop::base
