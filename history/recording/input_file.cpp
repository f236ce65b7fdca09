// SPDX-License-Identifier: Apache-2.0
#include "history/recording/input_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>

#include "core/base/file_problem.h"
#include "core/base/read_file.h"
#include "history/recording/record_bytes.h"

namespace indurop::recording {

using base::Problem;

RecordHead record_head(View bytes) {
  FieldReader reader(bytes);
  std::uint8_t opcode = 0;
  std::uint64_t length = 0;
  (void)(reader.get(opcode) && reader.get(length));
  return {static_cast<Opcode>(opcode), length};
}

Result<InputFile, Problem> InputFile::open(const std::filesystem::path& path) {
  auto opened = base::open_file(path);
  if (!opened) {
    return Problem{base::cannot_read(path, opened.error())};
  }
  return InputFile(path, std::move(opened->file), opened->size);
}

Problem InputFile::problem(std::uint64_t offset, std::string_view why) const {
  return {fmt::format("{}: byte {}: {}", path_.string(), offset, why)};
}

Result<Block, Problem> InputFile::read(std::uint64_t offset, std::uint64_t length) const {
  if (!has(offset, length)) {
    return problem(offset, fmt::format("{} bytes should follow, but the file ends at byte {}", length, size_));
  }
  Block block = make_block(length);
  for (std::uint64_t done = 0; done < length;) {
    const ssize_t got =
        ::pread(file_.get(), block.bytes.get() + done, length - done, static_cast<off_t>(offset + done));
    if (got == 0) {
      return problem(offset + done, "the file has become shorter while it was read");
    }
    if (got < 0 && errno != EINTR) {
      return Problem{base::cannot_read(path_, base::file_problem(errno))};
    }
    done += got < 0 ? 0 : static_cast<std::uint64_t>(got);
  }
  return block;
}

Result<Block, Problem> InputFile::read_content(Opcode opcode, std::uint64_t offset, std::uint64_t length,
                                               std::uint64_t most) const {
  auto head = read(offset, kRecordHead);
  if (!head) {
    return head;
  }
  const RecordHead found = record_head(head->view());
  if (found.opcode != opcode || length < kRecordHead || found.length != length - kRecordHead) {
    return problem(offset,
                   fmt::format("a record of kind {} and {} bytes should be here", static_cast<int>(opcode), length));
  }
  if (found.length > most) {
    return problem(offset, fmt::format("a record of {} bytes; at most {} are read", found.length, most));
  }
  return read(offset + kRecordHead, found.length);
}

}  // namespace indurop::recording
