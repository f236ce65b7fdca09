// SPDX-License-Identifier: Apache-2.0
#include "history/recording/segment.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "history/recording/crc32.h"
#include "history/recording/record_bytes.h"

namespace indurop::recording {
namespace {

using base::Problem;

// In addition to the records a chunk's content has some numbers and a word.
constexpr std::uint64_t kMaxOtherBytes = 1024;

Result<Block, Problem> read_chunk(const InputFile& file, const Segment& segment) {
  auto content = file.read_content(Opcode::Chunk, segment.offset, segment.length, kMaxChunkBytes + kMaxOtherBytes);
  if (!content) {
    return content;
  }
  McapChunk chunk;
  if (!read_record(content->view(), chunk)) {
    return file.problem(segment.offset, "a damaged chunk: its fields are longer than itself");
  }
  auto records = decompress(chunk.compression, chunk.records.view, chunk.size);
  if (!records) {
    return file.problem(segment.offset, "a damaged chunk: " + records.error().text);
  }
  const std::uint32_t crc = chunk.crc == 0 ? 0 : crc32(records->view());
  if (crc != chunk.crc) {
    return file.problem(segment.offset,
                        fmt::format("a damaged chunk: its CRC is {:08x}, it should be {:08x}", crc, chunk.crc));
  }
  return records;
}

// Returns false if it is not valid for its kind.
bool take_record(LoadedSegment& to, const RecordHead& head, View content, std::uint64_t offset) {
  switch (head.opcode) {
    case Opcode::Message: {
      McapMessage message;
      if (!read_record(content, message)) {
        return false;
      }
      to.messages.push_back({message.log_time_ns, offset, content.size()});
      return true;
    }
    case Opcode::Schema:
      return read_record(content, to.schemas.emplace_back());
    case Opcode::Channel:
      return read_record(content, to.channels.emplace_back());
    default:
      return head.opcode != Opcode{};
  }
}

}  // namespace

McapMessage LoadedSegment::message(const Entry& entry) const {
  McapMessage out;
  (void)read_record(records.view().subspan(entry.offset, entry.length), out);  // was read before
  return out;
}

Result<LoadedSegment, Problem> load(const InputFile& file, const Segment& segment) {
  auto records = segment.is_chunk ? read_chunk(file, segment) : file.read(segment.offset, segment.length);
  if (!records) {
    return std::move(records).error();
  }
  LoadedSegment out;
  out.records = std::move(*records);
  const View bytes = out.records.view();
  for (std::uint64_t at = 0; at < bytes.size();) {
    const std::uint64_t room = bytes.size() - at;
    const RecordHead head = room < kRecordHead ? RecordHead{} : record_head(bytes.subspan(at));
    if (room < kRecordHead || head.length > room - kRecordHead ||
        !take_record(out, head, bytes.subspan(at + kRecordHead, head.length), at + kRecordHead)) {
      return file.problem(segment.offset, fmt::format("a damaged chunk: no record begins at its byte {}", at));
    }
    at += kRecordHead + head.length;
  }
  const auto earlier = [](const auto& a, const auto& b) { return a.log_time_ns < b.log_time_ns; };
  if (!std::is_sorted(out.messages.begin(), out.messages.end(), earlier)) {
    std::stable_sort(out.messages.begin(), out.messages.end(), earlier);
  }
  return out;
}

}  // namespace indurop::recording
