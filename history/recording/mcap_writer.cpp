// SPDX-License-Identifier: Apache-2.0
#include "history/recording/mcap_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>

#include "history/recording/crc32.h"
#include "history/recording/record_bytes.h"

namespace indurop::recording {
namespace {

using base::Problem;

constexpr std::uint16_t kMaxIds = std::numeric_limits<std::uint16_t>::max();

}  // namespace

Result<McapWriter, Problem> McapWriter::create(const std::filesystem::path& path, const McapOptions& options) {
  auto file = AppendFile::create(path);
  if (!file) {
    return std::move(file).error();
  }
  Bytes beginning(kMagic.begin(), kMagic.end());
  append_record(beginning, McapHeader{"indurop", "InduRoP " INDUROP_VERSION});
  if (auto written = file->append(beginning); !written) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    return std::move(written).error();
  }
  return McapWriter(std::move(*file), options);
}

Problem McapWriter::refused(std::string_view why) const {
  return {fmt::format("{}: {}", file_.path().string(), why)};
}

Result<std::uint16_t, Problem> McapWriter::add_schema(std::string_view name, std::string_view encoding,
                                                      std::string_view data) {
  if (statistics_.schemas == kMaxIds) {
    return refused("a recording has at most 65535 schemas");
  }
  const auto id = static_cast<std::uint16_t>(statistics_.schemas + 1);
  portion_.clear();
  append_record(portion_, McapSchema{id, std::string(name), std::string(encoding), std::string(data)});
  if (auto written = file_.append(portion_); !written) {
    return std::move(written).error();
  }
  schemas_.insert(schemas_.end(), portion_.begin(), portion_.end());
  statistics_.schemas = id;
  return id;
}

Result<std::uint16_t, Problem> McapWriter::add_channel(std::uint16_t schema, std::string_view topic,
                                                       std::string_view encoding, const TextMap& metadata) {
  if (statistics_.channels == kMaxIds) {
    return refused("a recording has at most 65535 channels");
  }
  if (schema > statistics_.schemas) {
    return refused(fmt::format("there is no schema {}", schema));
  }
  const auto id = static_cast<std::uint16_t>(statistics_.channels + 1);
  portion_.clear();
  append_record(portion_, McapChannel{id, schema, std::string(topic), std::string(encoding), metadata});
  if (auto written = file_.append(portion_); !written) {
    return std::move(written).error();
  }
  channels_.insert(channels_.end(), portion_.begin(), portion_.end());
  statistics_.channels = id;
  statistics_.channel_messages.emplace_back(id, 0);
  return id;
}

bool McapWriter::chunk_is_full(std::uint64_t log_time_ns) const {
  return chunk_.records().size() >= options_.chunk_bytes ||
         (!chunk_.empty() && log_time_ns > chunk_.start_ns() &&
          log_time_ns - chunk_.start_ns() >= static_cast<std::uint64_t>(options_.chunk_time.count()));
}

Result<void, Problem> McapWriter::write(std::uint16_t channel, std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
                                        std::uint32_t sequence, View bytes) {
  if (channel == 0 || channel > statistics_.channels) {
    return refused(fmt::format("there is no channel {}", channel));
  }
  if (bytes.size() > kMaxMessageBytes) {
    return refused(fmt::format("a message of {} bytes is too large, {} are allowed", bytes.size(), kMaxMessageBytes));
  }
  if (chunk_is_full(log_time_ns)) {
    if (auto flushed = flush(); !flushed) {
      return flushed;
    }
  }
  chunk_.add({channel, sequence, log_time_ns, publish_time_ns, {bytes}});
  return {};
}

Result<void, Problem> McapWriter::flush() {
  if (chunk_.empty()) {
    return {};
  }
  View stored = chunk_.records();
  if (options_.compress) {
    auto compressed = compressor_.compress(stored);
    if (!compressed) {
      return refused(compressed.error().text);
    }
    stored = *compressed;
  }
  McapChunk chunk{chunk_.start_ns(),
                  chunk_.end_ns(),
                  chunk_.records().size(),
                  crc32(chunk_.records()),
                  options_.compress ? "zstd" : "",
                  {stored}};
  portion_.clear();
  append_record(portion_, chunk);
  McapChunkIndex index{chunk.start_ns,    chunk.end_ns,  file_.size(), portion_.size(), {}, 0,
                       chunk.compression, stored.size(), chunk.size};
  for (const std::uint16_t channel : chunk_.channels()) {
    index.index_offsets.emplace_back(channel, file_.size() + portion_.size());
    append_record(portion_, chunk_.index_of(channel));
  }
  index.index_length = portion_.size() - index.length;
  if (auto written = file_.append(portion_); !written) {
    return written;
  }
  append_record(chunk_indexes_, index);
  const bool first = statistics_.chunks == 0;
  statistics_.start_ns = first ? chunk.start_ns : std::min(statistics_.start_ns, chunk.start_ns);
  statistics_.end_ns = first ? chunk.end_ns : std::max(statistics_.end_ns, chunk.end_ns);
  ++statistics_.chunks;
  for (const std::uint16_t channel : chunk_.channels()) {
    const std::uint64_t count = chunk_.index_of(channel).entries.size();
    statistics_.channel_messages[channel - std::size_t{1}].second += count;
    statistics_.messages += count;
  }
  chunk_.clear();
  return {};
}

Result<void, Problem> McapWriter::attach(const McapAttachment& about, View bytes) {
  if (bytes.size() > kMaxAttachmentBytes) {
    return refused(
        fmt::format("attachment '{}' has {} bytes, {} are allowed", about.name, bytes.size(), kMaxAttachmentBytes));
  }
  portion_.clear();
  append_record(portion_, about);
  FieldWriter fields(portion_);
  fields.put(LongBytes{bytes});
  fields.put(crc32(View(portion_).subspan(kRecordHead)));
  const std::uint64_t length = portion_.size() - kRecordHead;
  std::memcpy(portion_.data() + 1, &length, sizeof length);
  const std::uint64_t offset = file_.size();
  if (auto written = file_.append(portion_); !written) {
    return written;
  }
  append_record(attachment_indexes_,
                McapAttachmentIndex{offset, portion_.size(), about.log_time_ns, about.create_time_ns, bytes.size(),
                                    about.name, about.media_type});
  ++statistics_.attachments;
  return {};
}

Result<void, Problem> McapWriter::metadata(std::string_view name, const TextMap& values) {
  portion_.clear();
  append_record(portion_, McapMetadata{std::string(name), values});
  const std::uint64_t offset = file_.size();
  if (auto written = file_.append(portion_); !written) {
    return written;
  }
  append_record(metadata_indexes_, McapMetadataIndex{offset, portion_.size(), std::string(name)});
  ++statistics_.metadata;
  return {};
}

// Returns the summary and everything after it, for byte `at` of the file.
Bytes McapWriter::summary(std::uint64_t at) const {
  Bytes statistics;
  append_record(statistics, statistics_);
  Bytes out;
  Bytes offsets;
  for (const Bytes* group : {&schemas_, &channels_, &chunk_indexes_, &attachment_indexes_, &metadata_indexes_,
                             static_cast<const Bytes*>(&statistics)}) {
    if (!group->empty()) {
      append_record(offsets, McapSummaryOffset{group->front(), at + out.size(), group->size()});
      out.insert(out.end(), group->begin(), group->end());
    }
  }
  McapFooter footer{at, at + out.size(), 0};
  out.insert(out.end(), offsets.begin(), offsets.end());
  append_record(out, footer);
  // The footer's own CRC is the only field that the CRC does not cover.
  const std::uint32_t crc = crc32(View(out).first(out.size() - sizeof crc));
  std::memcpy(out.data() + out.size() - sizeof crc, &crc, sizeof crc);
  out.insert(out.end(), kMagic.begin(), kMagic.end());
  return out;
}

Result<void, Problem> McapWriter::close() {
  if (auto flushed = flush(); !flushed) {
    return flushed;
  }
  Bytes end;
  append_record(end, McapDataEnd{file_.crc()});
  const Bytes rest = summary(file_.size() + end.size());
  end.insert(end.end(), rest.begin(), rest.end());
  if (auto written = file_.append(end); !written) {
    return written;
  }
  return file_.close();
}

}  // namespace indurop::recording
