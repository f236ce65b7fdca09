// SPDX-License-Identifier: Apache-2.0
#include "core/base/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <optional>

namespace indurop::base {
namespace {

using Kind = FileProblem::Kind;

std::optional<FileProblem> not_regular(mode_t mode) {
  if (S_ISREG(mode)) {
    return std::nullopt;
  }
  if (S_ISDIR(mode)) {
    return FileProblem{Kind::Directory, EISDIR, "it is a directory, not a file"};
  }
  const char* what = S_ISFIFO(mode) ? "pipe" : S_ISSOCK(mode) ? "socket" : "device";
  return FileProblem{Kind::NotRegular, EINVAL, std::string("it is a ") + what + ", not a file"};
}

std::string with_unit(std::size_t bytes) {
  constexpr std::size_t kMebi = std::size_t{1} << 20U;
  return bytes % kMebi == 0 ? std::to_string(bytes / kMebi) + " MiB" : std::to_string(bytes) + " bytes";
}

}  // namespace

Result<OpenFile, FileProblem> open_file(const std::filesystem::path& path) {
  // Checked before it is opened: opening some devices has side effects. Checked again, as it may be another file by
  // then.
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    return file_problem(errno);
  }
  if (auto problem = not_regular(status.st_mode)) {
    return *std::move(problem);
  }
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!file.is_open() || ::fstat(file.get(), &status) != 0) {
    return file_problem(errno);
  }
  if (auto problem = not_regular(status.st_mode)) {
    return *std::move(problem);
  }
  return OpenFile{std::move(file), static_cast<std::uint64_t>(status.st_size)};
}

Result<std::string, FileProblem> read_file(const std::filesystem::path& path, std::size_t most) {
  auto opened = open_file(path);
  if (!opened) {
    return std::move(opened).error();
  }
  // The size is a hint: kernel files have none, others may grow. One byte more than allowed shows that it is too large.
  constexpr std::size_t kStep = std::size_t{64} << 10U;
  std::string bytes;
  std::size_t used = 0;
  while (used <= most) {
    if (used == bytes.size()) {
      const std::size_t hint = used == 0 && opened->size < most ? static_cast<std::size_t>(opened->size) + 1 : 0;
      bytes.resize(std::min(most + 1, used + std::max({hint, used, kStep})));
    }
    const ssize_t got = ::read(opened->file.get(), bytes.data() + used, bytes.size() - used);
    if (got < 0 && errno != EINTR) {
      return file_problem(errno);
    }
    if (got == 0) {
      bytes.resize(used);
      return bytes;
    }
    used += got < 0 ? 0 : static_cast<std::size_t>(got);
  }
  return FileProblem{Kind::TooLarge, EFBIG, "it is larger than " + with_unit(most)};
}

}  // namespace indurop::base
