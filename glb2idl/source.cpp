// SPDX-License-Identifier: Apache-2.0
// Reading .glb files and finding lines and columns in them.

#include "glb2idl/source.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/base/read_file.h"
#include "core/base/utf8.h"

namespace indurop::glb2idl {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string reason(const base::FileProblem& problem) {
  switch (problem.kind) {
    case base::FileProblem::Kind::Directory:
      return "it is a directory, name a .glb file";
    case base::FileProblem::Kind::NotRegular:
      return "it is not a regular file, name a .glb file";
    case base::FileProblem::Kind::TooLarge:
      return problem.text + ", split it";
    case base::FileProblem::Kind::System:
      break;
  }
  switch (problem.sys_errno) {
    case ENOENT:
    case ENOTDIR:
      return "there is no such file, check the path";
    case EACCES:
      return "no permission to read it, change its rights";
    default:
      return problem.text;
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

int Sources::line_of(Span at) const noexcept {
  const auto& lines = files_[at.file].lines;
  return static_cast<int>(std::upper_bound(lines.begin(), lines.end(), at.offset) - lines.begin());
}

base::SourcePlace Sources::place_of(Span at) const noexcept {
  const SourceFile& source = files_[at.file];
  const int line = line_of(at);
  const std::size_t begin = source.lines[static_cast<std::size_t>(line) - 1];
  const std::string_view before = std::string_view(source.text).substr(begin, at.offset - begin);
  const auto continuation = std::count_if(before.begin(), before.end(), base::continues_utf8);
  return {line, static_cast<int>(before.size() - static_cast<std::size_t>(continuation) + 1)};
}

std::string_view Sources::line_text(std::uint32_t file, int line) const noexcept {
  const SourceFile& source = files_[file];
  const std::string_view rest = std::string_view(source.text).substr(source.lines[static_cast<std::size_t>(line) - 1]);
  std::string_view text = rest.substr(0, rest.find('\n'));
  if (text.ends_with('\r')) {
    text.remove_suffix(1);
  }
  return text;
}

ReadResult read_source_file(const std::string& path) {
  auto text = base::read_file(path, kMaxFileBytes);
  if (!text) {
    return {std::nullopt, "", reason(text.error())};
  }
  std::error_code failed;
  const std::filesystem::path canonical = std::filesystem::canonical(path, failed);
  return {std::move(*text), failed ? path : canonical.string(), ""};
}

}  // namespace indurop::glb2idl
