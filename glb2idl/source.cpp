// SPDX-License-Identifier: Apache-2.0
// Reading .glb files and finding lines and columns in them.

#include "glb2idl/source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "schema/utf8.h"

namespace indurop::glb2idl {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Closes a file descriptor at the end of its scope.
class OpenFile {
 public:
  explicit OpenFile(int fd) noexcept : fd_(fd) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() { ::close(fd_); }

 private:
  int fd_;
};

std::string reason(int number) {
  switch (number) {
    case ENOENT:
    case ENOTDIR:
      return "there is no such file, check the path";
    case EACCES:
      return "no permission to read it, change its rights";
    default:
      return std::generic_category().message(number);
  }
}

}  // namespace

Span join(Span first, Span last) noexcept {
  const std::uint32_t end = std::max(last.offset + last.length, first.offset + first.length);
  return {first.file, first.offset, end - first.offset};
}

std::uint32_t Sources::add(std::string path, std::string identity, std::string text) {
  if (text.starts_with(kByteOrderMark)) {
    text.erase(0, kByteOrderMark.size());
  }
  if (text.empty() || text.back() != '\n') {
    text += '\n';
  }
  SourceFile file{std::move(path), std::move(identity), std::move(text), {0}};
  for (std::size_t i = 0; i + 1 < file.text.size(); ++i) {
    if (file.text[i] == '\n') {
      file.lines.push_back(static_cast<std::uint32_t>(i + 1));
    }
  }
  files_.push_back(std::move(file));
  return static_cast<std::uint32_t>(files_.size() - 1);
}

std::optional<std::uint32_t> Sources::find(std::string_view identity) const noexcept {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    if (files_[i].identity == identity) {
      return static_cast<std::uint32_t>(i);
    }
  }
  return std::nullopt;
}

std::uint32_t Sources::line_of(Span at) const noexcept {
  const auto& lines = files_[at.file].lines;
  return static_cast<std::uint32_t>(std::upper_bound(lines.begin(), lines.end(), at.offset) - lines.begin());
}

LineColumn Sources::place_of(Span at) const noexcept {
  const SourceFile& source = files_[at.file];
  const std::uint32_t line = line_of(at);
  const std::string_view before =
      std::string_view(source.text).substr(source.lines[line - 1], at.offset - source.lines[line - 1]);
  const auto continuation = std::count_if(before.begin(), before.end(), schema::continues_utf8);
  return {line, static_cast<std::uint32_t>(before.size() - static_cast<std::size_t>(continuation) + 1)};
}

std::string_view Sources::line_text(std::uint32_t file, std::uint32_t line) const noexcept {
  const SourceFile& source = files_[file];
  const std::string_view rest = std::string_view(source.text).substr(source.lines[line - 1]);
  std::string_view text = rest.substr(0, rest.find('\n'));
  if (text.ends_with('\r')) {
    text.remove_suffix(1);
  }
  return text;
}

ReadResult read_source_file(const std::string& path) {
  // Non-blocking: a FIFO given by mistake must not hang the build.
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) {
    return {std::nullopt, "", reason(errno)};
  }
  const OpenFile closer(fd);
  struct stat status {};
  if (::fstat(fd, &status) != 0) {
    return {std::nullopt, "", reason(errno)};
  }
  if (S_ISDIR(status.st_mode)) {
    return {std::nullopt, "", "it is a directory, name a .glb file"};
  }
  if (!S_ISREG(status.st_mode)) {
    return {std::nullopt, "", "it is not a regular file, name a .glb file"};
  }
  std::string text;
  std::string chunk(std::size_t{1} << 16U, '\0');
  while (true) {
    const ssize_t got = ::read(fd, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      return {std::nullopt, "", reason(errno)};
    }
    if (got == 0) {
      break;
    }
    text.append(chunk, 0, static_cast<std::size_t>(got));
    if (text.size() > kMaxFileBytes) {
      return {std::nullopt, "", "it is larger than 4 MiB, split it"};
    }
  }
  std::error_code failed;
  const std::filesystem::path canonical = std::filesystem::canonical(path, failed);
  return {std::move(text), failed ? path : canonical.string(), ""};
}

}  // namespace indurop::glb2idl
