// SPDX-License-Identifier: Apache-2.0
// The .glb texts of one compilation, and places in them for messages.

#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/source_place.h"

namespace indurop::glb2idl {

// A range of text in one file.
struct Span {
  std::uint32_t file = 0;
  std::uint32_t offset = 0;
  std::uint32_t length = 0;
};

// Returns the span from the beginning of `first` to the end of `last`, both in the same file.
[[nodiscard]] Span join(Span first, Span last) noexcept;

struct SourceFile {
  std::string path;                  // as the user wrote it, for messages
  std::string identity;              // equal for two paths of the same file
  std::string text;                  // ends with a newline; without byte order mark
  std::vector<std::uint32_t> lines;  // offset of each line's first byte
};

class Sources {
 public:
  std::uint32_t add(std::string path, std::string identity, std::string text);
  [[nodiscard]] const SourceFile& file(std::uint32_t index) const { return files_[index]; }
  [[nodiscard]] std::size_t size() const noexcept { return files_.size(); }
  [[nodiscard]] std::optional<std::uint32_t> find(std::string_view identity) const noexcept;

  [[nodiscard]] int line_of(Span at) const noexcept;  // from 1
  [[nodiscard]] base::SourcePlace place_of(Span at) const noexcept;
  [[nodiscard]] std::string_view line_text(std::uint32_t file, int line) const noexcept;

 private:
  std::deque<SourceFile> files_;  // a deque, because tokens refer to the texts
};

// The result of reading a file: its text, or the reason of the failure.
struct ReadResult {
  std::optional<std::string> text;
  std::string identity;
  std::string why;  // "there is no such file, check the path", ...
};
using FileReader = std::function<ReadResult(const std::string& path)>;

inline constexpr std::size_t kMaxFileBytes = std::size_t{4} << 20U;

// Reads from the file system; regular files up to kMaxFileBytes.
[[nodiscard]] ReadResult read_source_file(const std::string& path);

}  // namespace indurop::glb2idl
