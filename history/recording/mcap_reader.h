// SPDX-License-Identifier: Apache-2.0
// Reads MCAP files, our own and third-party ones: with or without a summary; of truncated or damaged ones the intact
// part. Every number in a file is checked against the file's size before it is used. Not real-time safe; one thread at
// a time.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "history/recording/contents.h"
#include "history/recording/input_file.h"
#include "history/recording/records.h"
#include "history/recording/segment.h"

namespace indurop::recording {

// All errors name the file, the byte offset and what is wrong there.
class McapReader {
 public:
  // Opens the file with its present content; what is added later is not seen. Errors: it cannot be read, or is no MCAP
  // file.
  static Result<McapReader, base::Problem> open(const std::filesystem::path& path);

  // Header, schemas, channels, attachments, metadata; whether the file was closed, and what had to be skipped.
  [[nodiscard]] const Contents& contents() const noexcept { return contents_; }

  // Returns the next message in the order of log times, those of the same time in the order of the file; nullopt after
  // the last one. Its bytes are valid until the next call. Errors: a part of the file is damaged; the next call
  // continues after it.
  Result<std::optional<McapMessage>, base::Problem> next();
  // Calls `use` for the remaining messages except those later than `until_ns`. Returns which parts of the file are
  // missing, including those known since open(); stops at the hundredth such damage.
  std::vector<std::string> each(const std::function<void(const McapMessage&)>& use,
                                std::uint64_t until_ns = std::numeric_limits<std::uint64_t>::max());
  // next() continues with the first message that is not older than this.
  void seek(std::uint64_t log_time_ns);

  // Returns the chunks, and other parts, in the order in which they begin.
  [[nodiscard]] const std::vector<Segment>& segments() const noexcept { return by_time_; }
  // Reads one of them. Errors: it is damaged.
  [[nodiscard]] Result<LoadedSegment, base::Problem> load(const Segment& segment) const;

  // Returns the bytes of an attachment. Errors: wrong CRC, or not as the summary says.
  [[nodiscard]] Result<Bytes, base::Problem> attachment(const McapAttachmentIndex& index) const;
  [[nodiscard]] Result<McapMetadata, base::Problem> metadata(const McapMetadataIndex& index) const;

 private:
  // A segment whose messages are being read.
  struct Open {
    LoadedSegment loaded;
    std::size_t next = 0;
    std::uint64_t offset = 0;
    [[nodiscard]] const LoadedSegment::Entry& entry() const { return loaded.messages[next]; }
    // Inverted order, so that a heap returns the earliest message first.
    bool operator<(const Open& other) const {
      return std::pair(entry().log_time_ns, offset) > std::pair(other.entry().log_time_ns, other.offset);
    }
  };

  McapReader(InputFile file, Contents contents);
  Result<void, base::Problem> open_segment(const Segment& segment);

  InputFile file_;
  Contents contents_;
  std::vector<Segment> by_time_;
  std::size_t next_segment_ = 0;
  std::uint64_t from_ns_ = 0;
  std::vector<Open> open_;        // heap
  std::uint64_t open_bytes_ = 0;  // total size of its records
  std::optional<Open> last_;      // the segment of the last message, if that was its last one
};

}  // namespace indurop::recording
