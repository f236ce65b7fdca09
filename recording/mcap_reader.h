// SPDX-License-Identifier: Apache-2.0
// Reads MCAP files, ours and those of others: with a summary or without, cut or damaged ones as far as they are whole.
// Nothing a file says is believed before it was compared with the file's size. Not real-time safe; one thread at a
// time.

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

#include "base/problem.h"
#include "recording/contents.h"
#include "recording/input_file.h"
#include "recording/records.h"
#include "recording/segment.h"

namespace indurop::recording {

// All errors say the file, the byte and what is wrong there.
class McapReader {
 public:
  // What the file holds now; what is added later is not seen. Errors: it cannot be read, or is no MCAP file.
  static Result<McapReader, base::Problem> open(const std::filesystem::path& path);

  // Header, schemas, channels, attachments, metadata; whether it was closed, and what had to be passed over.
  [[nodiscard]] const Contents& contents() const noexcept { return contents_; }

  // The next message in the order of log times, those of the same time in the order of the file; nullopt behind the
  // last one. Its bytes are valid until the next call. Errors: a part of the file is damaged; the next call goes on
  // behind it.
  Result<std::optional<McapMessage>, base::Problem> next();
  // Gives the messages that are left to `use`, but for those that are younger than `until_ns`. Returns what of the file
  // is not among them, as far as it is known from open() on; the hundredth such damage ends it.
  std::vector<std::string> each(const std::function<void(const McapMessage&)>& use,
                                std::uint64_t until_ns = std::numeric_limits<std::uint64_t>::max());
  // next() goes on with the first message that is not older than this.
  void seek(std::uint64_t log_time_ns);

  // The bytes of an attachment. Errors: wrong CRC, or not as the summary says.
  [[nodiscard]] Result<Bytes, base::Problem> attachment(const McapAttachmentIndex& index) const;
  [[nodiscard]] Result<McapMetadata, base::Problem> metadata(const McapMetadataIndex& index) const;

 private:
  // A segment whose messages are being read.
  struct Open {
    LoadedSegment loaded;
    std::size_t next = 0;
    std::uint64_t offset = 0;
    [[nodiscard]] const LoadedSegment::Entry& entry() const { return loaded.messages[next]; }
    // What comes out of a heap last.
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
  std::vector<Open> open_;        // a heap
  std::uint64_t open_bytes_ = 0;  // of the records in it
  std::optional<Open> last_;      // that of the last message, if it was its last one too
};

}  // namespace indurop::recording
