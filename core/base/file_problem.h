// SPDX-License-Identifier: Apache-2.0
// Why a file could not be read or written.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace indurop::base {

struct FileProblem {
  enum class Kind : std::uint8_t {
    System,      // the operating system refused: sys_errno
    Directory,   // it is a directory
    NotRegular,  // it is a pipe, a device or a socket
    TooLarge,    // it is longer than the caller accepts
  };
  Kind kind = Kind::System;
  int sys_errno = 0;
  std::string text;  // the reason alone, to follow "cannot read FILE: "
};

// Makes the problem for an errno.
FileProblem file_problem(int error);
// "cannot read FILE: No such file or directory".
std::string cannot_read(const std::filesystem::path& file, const FileProblem& problem);
std::string cannot_write(const std::filesystem::path& file, const FileProblem& problem);

}  // namespace indurop::base
