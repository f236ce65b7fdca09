// SPDX-License-Identifier: Apache-2.0
// Writes an MCAP file. Messages are collected in a chunk, which is written as a whole: however the program ends, the
// file is readable up to its last chunk. Not real-time safe; one thread at a time.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "history/recording/append_file.h"
#include "history/recording/chunk_builder.h"
#include "history/recording/compression.h"
#include "history/recording/records.h"

namespace indurop::recording {

struct McapOptions {
  // A chunk is closed when it has this many bytes, or when its first message is older (in log time) by this than the
  // next one.
  std::uint64_t chunk_bytes = std::uint64_t{1} << 20U;
  std::chrono::nanoseconds chunk_time = std::chrono::seconds(1);
  bool compress = true;  // with zstd
};

// All errors name the file; after those of the disk (it is full) the writer is unchanged, so a call can be repeated
// when there is room again. A writer that ends without close() leaves a file without a summary, and loses the open
// chunk.
class McapWriter {
 public:
  // Errors: a file of this name exists already; it cannot be written.
  static Result<McapWriter, base::Problem> create(const std::filesystem::path& path, const McapOptions& options);

  // Returns the number that channels use for the schema, or write() for the channel. Errors: more than 65535 of them.
  Result<std::uint16_t, base::Problem> add_schema(std::string_view name, std::string_view encoding,
                                                  std::string_view data);
  // `schema` 0: none.
  Result<std::uint16_t, base::Problem> add_channel(std::uint16_t schema, std::string_view topic,
                                                   std::string_view encoding, const TextMap& metadata);
  // Errors: no such channel; more than kMaxMessageBytes; a full chunk cannot be written, then the message is not
  // accepted.
  Result<void, base::Problem> write(std::uint16_t channel, std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
                                    std::uint32_t sequence, View bytes);
  Result<void, base::Problem> attach(const McapAttachment& about, View bytes);
  Result<void, base::Problem> metadata(std::string_view name, const TextMap& values);
  // Closes the chunk now, for a caller that will have no messages for a while. It is in the file then, but not yet on
  // the disk.
  Result<void, base::Problem> flush();
  // Begins to bring to the disk what is in the file.
  Result<void, base::Problem> begin_sync() { return file_.begin_sync(); }
  // Writes the summary; returns when all is on the disk. Afterwards nothing may be called, except close() again if it
  // failed.
  Result<void, base::Problem> close();

  // Size of the file; the open chunk is not counted.
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
  Bytes portion_;  // next bytes for the file; its memory is reused
  // The records of the summary, already encoded: a recording of a day has many chunks.
  Bytes schemas_;
  Bytes channels_;
  Bytes chunk_indexes_;
  Bytes attachment_indexes_;
  Bytes metadata_indexes_;
  McapStatistics statistics_;
};

}  // namespace indurop::recording
