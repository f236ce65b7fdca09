// SPDX-License-Identifier: Apache-2.0
// A file that is read at given offsets, and the format of its error messages: "FILE: byte 123: what is wrong".

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/base/descriptor.h"
#include "core/base/problem.h"
#include "history/recording/compression.h"
#include "history/recording/records.h"

namespace indurop::recording {

// The head of each record.
struct RecordHead {
  Opcode opcode{};
  std::uint64_t length = 0;  // length of the content
};

class InputFile {
 public:
  // Errors: it cannot be read; it is no regular file.
  static Result<InputFile, base::Problem> open(const std::filesystem::path& path);

  // The size when it was opened; it may have grown since.
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  [[nodiscard]] bool has(std::uint64_t offset, std::uint64_t length) const noexcept {
    return offset <= size_ && length <= size_ - offset;
  }
  [[nodiscard]] base::Problem problem(std::uint64_t offset, std::string_view why) const;

  // Errors: the file is shorter than that; the operating system cannot read it.
  [[nodiscard]] Result<Block, base::Problem> read(std::uint64_t offset, std::uint64_t length) const;
  // Reads the content of a record with this opcode and `length` bytes, its head included. Errors: as above; the file
  // has another record there; its content is longer than `most`.
  [[nodiscard]] Result<Block, base::Problem> read_content(Opcode opcode, std::uint64_t offset, std::uint64_t length,
                                                          std::uint64_t most) const;

 private:
  InputFile(std::filesystem::path path, base::Descriptor file, std::uint64_t size)
      : path_(std::move(path)), file_(std::move(file)), size_(size) {}

  std::filesystem::path path_;
  base::Descriptor file_;
  std::uint64_t size_;
};

// `bytes` must have at least kRecordHead bytes.
RecordHead record_head(View bytes);

}  // namespace indurop::recording
