// SPDX-License-Identifier: Apache-2.0
// Writes an MCAP file. Messages wait in a chunk, which goes to the file as a whole: whatever ends the program, the file
// is readable up to its last chunk. Not real-time safe; one thread at a time.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/problem.h"
#include "recording/append_file.h"
#include "recording/chunk_builder.h"
#include "recording/compression.h"
#include "recording/records.h"

namespace indurop::recording {

struct McapOptions {
  // A chunk with so many bytes, or whose first message is so much older (in log time) than the next one, is closed.
  std::uint64_t chunk_bytes = std::uint64_t{1} << 20U;
  std::chrono::nanoseconds chunk_time = std::chrono::seconds(1);
  bool compress = true;  // with zstd
};

// All errors say which file; those of the disk (it is full) leave the writer as it was, so a call can be repeated when
// there is room again. A writer that ends without close() leaves a file without a summary, and loses the open chunk.
class McapWriter {
 public:
  // Errors: there is a file of this name already; it cannot be written.
  static Result<McapWriter, base::Problem> create(const std::filesystem::path& path, const McapOptions& options);

  // Return the number by which channels name the schema, and write() the channel. Errors: more than 65535 of them.
  Result<std::uint16_t, base::Problem> add_schema(std::string_view name, std::string_view encoding,
                                                  std::string_view data);
  // `schema` 0: none.
  Result<std::uint16_t, base::Problem> add_channel(std::uint16_t schema, std::string_view topic,
                                                   std::string_view encoding, const TextMap& metadata);
  // Errors: no such channel; more than kMostMessageBytes; a chunk that was full cannot be written, then the message is
  // not taken.
  Result<void, base::Problem> write(std::uint16_t channel, std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
                                    std::uint32_t sequence, View bytes);
  Result<void, base::Problem> attach(const McapAttachment& about, View bytes);
  Result<void, base::Problem> metadata(std::string_view name, const TextMap& values);
  // Closes the chunk now, as somebody does who has no messages for a while. It is in the file then, not yet on the
  // disk.
  Result<void, base::Problem> flush();
  // Writes the summary; returns when all is on the disk. Nothing may be called afterwards, unless it failed: then it
  // may be repeated.
  Result<void, base::Problem> close();

  // Of the file; the open chunk is not counted.
  [[nodiscard]] std::uint64_t size() const noexcept { return file_.size(); }

 private:
  McapWriter(AppendFile file, const McapOptions& options) : options_(options), file_(std::move(file)) {}
  [[nodiscard]] bool chunk_is_full(std::uint64_t log_time_ns) const;
  [[nodiscard]] base::Problem refused(std::string_view why) const;
  [[nodiscard]] Bytes summary(std::uint64_t at) const;

  McapOptions options_;
  AppendFile file_;
  ZstdCompressor compressor_;
  ChunkBuilder chunk_;
  Bytes portion_;  // what goes to the file next; its memory is used again
  // What the summary will hold, as records: a recording of a day has many chunks.
  Bytes schemas_;
  Bytes channels_;
  Bytes chunk_indexes_;
  Bytes attachment_indexes_;
  Bytes metadata_indexes_;
  McapStatistics statistics_;
};

}  // namespace indurop::recording
