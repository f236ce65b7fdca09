// SPDX-License-Identifier: Apache-2.0
#include "core/base/clone_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>

#include "core/base/descriptor.h"
#include "core/base/file_problem.h"
#include "core/base/read_file.h"
#include "core/base/write_all.h"

namespace indurop::base {
namespace {

constexpr mode_t kFileMode = 0640;

// Copies some bytes from the places of both files on. Returns how many; -1: errno says why it failed.
ssize_t copy_part(int from, int to) {
  std::array<char, 65536> part{};
  const ssize_t size = ::read(from, part.data(), part.size());
  if (size > 0) {
    errno = write_all(to, {part.data(), static_cast<std::size_t>(size)});
    return errno == 0 ? size : -1;
  }
  return size;
}

}  // namespace

Result<void, Problem> clone_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  const auto opened = open_file(from);
  if (!opened) {
    return Problem{cannot_read(from, opened.error())};
  }
  const Descriptor out(::open(to.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kFileMode));
  if (!out.is_open()) {
    return Problem{cannot_write(to, file_problem(errno))};
  }
  std::uint64_t left = opened->size;
  while (left > 0) {
    ssize_t copied = ::copy_file_range(opened->file.get(), nullptr, out.get(), nullptr, left, 0);
    if (copied < 0 && errno != ENOSPC) {  // these file systems cannot
      copied = copy_part(opened->file.get(), out.get());
    }
    if (copied < 0) {
      return Problem{cannot_write(to, file_problem(errno))};
    }
    if (copied == 0) {
      return Problem{cannot_read(from, file_problem(ENODATA))};  // it has become shorter
    }
    left -= static_cast<std::uint64_t>(copied);
  }
  return {};
}

}  // namespace indurop::base
