// SPDX-License-Identifier: Apache-2.0
// The records of an MCAP file (https://mcap.dev/spec), each with its fields in the order of the file. Times are
// nanoseconds since an epoch that the writer chooses.

#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace indurop::recording {

using Bytes = std::vector<std::uint8_t>;
using View = std::span<const std::uint8_t>;
using TextMap = std::map<std::string, std::string>;

inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
// The size of opcode and length, before each record's content.
inline constexpr std::uint64_t kRecordHead = 9;

// The size limits: more than any recording needs, and small enough for memory, whatever a damaged file states.
inline constexpr std::uint64_t kMaxMessageBytes = std::uint64_t{64} << 20U;
inline constexpr std::uint64_t kMaxChunkBytes = std::uint64_t{256} << 20U;
inline constexpr std::uint64_t kMaxAttachmentBytes = std::uint64_t{1} << 30U;

enum class Opcode : std::uint8_t {
  Header = 1,
  Footer = 2,
  Schema = 3,
  Channel = 4,
  Message = 5,
  Chunk = 6,
  MessageIndex = 7,
  ChunkIndex = 8,
  Attachment = 9,
  AttachmentIndex = 10,
  Statistics = 11,
  Metadata = 12,
  MetadataIndex = 13,
  SummaryOffset = 14,
  DataEnd = 15,
};

// Bytes preceded by a 64-bit length, and bytes up to the end of their record. Both refer to the buffer they were read
// from.
struct LongBytes {
  View view;
};
struct RestBytes {
  View view;
};

struct McapHeader {
  std::string profile;
  std::string library;
  static constexpr Opcode kOpcode = Opcode::Header;
  static void fields(auto& r, auto use) { use(r.profile, r.library); }
};

struct McapFooter {
  std::uint64_t summary_start = 0;  // 0: there is none
  std::uint64_t summary_offset_start = 0;
  std::uint32_t summary_crc = 0;  // 0, as in all of these: not computed
  static constexpr Opcode kOpcode = Opcode::Footer;
  static void fields(auto& r, auto use) { use(r.summary_start, r.summary_offset_start, r.summary_crc); }
};

struct McapSchema {
  std::uint16_t id = 0;
  std::string name;
  std::string encoding;  // "omgidl"
  std::string data;
  static constexpr Opcode kOpcode = Opcode::Schema;
  static void fields(auto& r, auto use) { use(r.id, r.name, r.encoding, r.data); }
  bool operator==(const McapSchema&) const = default;
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;  // 0: none
  std::string topic;
  std::string encoding;  // encoding of its messages: "cdr"
  TextMap metadata;
  static constexpr Opcode kOpcode = Opcode::Channel;
  static void fields(auto& r, auto use) { use(r.id, r.schema, r.topic, r.encoding, r.metadata); }
  bool operator==(const McapChannel&) const = default;
};

struct McapMessage {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  RestBytes data;
  static constexpr Opcode kOpcode = Opcode::Message;
  static void fields(auto& r, auto use) { use(r.channel, r.sequence, r.log_time_ns, r.publish_time_ns, r.data); }
};

struct McapChunk {
  std::uint64_t start_ns = 0;  // of its messages' log times; both are 0 without messages
  std::uint64_t end_ns = 0;
  std::uint64_t size = 0;  // uncompressed size of `records`
  std::uint32_t crc = 0;   // CRC of the uncompressed `records`
  std::string compression;
  LongBytes records;
  static constexpr Opcode kOpcode = Opcode::Chunk;
  static void fields(auto& r, auto use) { use(r.start_ns, r.end_ns, r.size, r.crc, r.compression, r.records); }
};

struct McapMessageIndex {
  std::uint16_t channel = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> entries;  // log time, offset in the chunk's records
  static constexpr Opcode kOpcode = Opcode::MessageIndex;
  static void fields(auto& r, auto use) { use(r.channel, r.entries); }
};

struct McapChunkIndex {
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint64_t offset = 0;                                            // of the chunk's record in the file
  std::uint64_t length = 0;                                            // of the whole record
  std::vector<std::pair<std::uint16_t, std::uint64_t>> index_offsets;  // channel, its message index in the file
  std::uint64_t index_length = 0;
  std::string compression;
  std::uint64_t compressed_size = 0;
  std::uint64_t size = 0;
  static constexpr Opcode kOpcode = Opcode::ChunkIndex;
  static void fields(auto& r, auto use) {
    use(r.start_ns, r.end_ns, r.offset, r.length, r.index_offsets, r.index_length, r.compression, r.compressed_size,
        r.size);
  }
};

// The fields before an attachment's bytes.
struct McapAttachment {
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;  // 0: not known
  std::string name;
  std::string media_type;
  static constexpr Opcode kOpcode = Opcode::Attachment;
  static void fields(auto& r, auto use) { use(r.log_time_ns, r.create_time_ns, r.name, r.media_type); }
};

struct McapAttachmentIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  std::uint64_t size = 0;
  std::string name;
  std::string media_type;
  static constexpr Opcode kOpcode = Opcode::AttachmentIndex;
  static void fields(auto& r, auto use) {
    use(r.offset, r.length, r.log_time_ns, r.create_time_ns, r.size, r.name, r.media_type);
  }
};

struct McapStatistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t metadata = 0;
  std::uint32_t chunks = 0;
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  std::vector<std::pair<std::uint16_t, std::uint64_t>> channel_messages;
  static constexpr Opcode kOpcode = Opcode::Statistics;
  static void fields(auto& r, auto use) {
    use(r.messages, r.schemas, r.channels, r.attachments, r.metadata, r.chunks, r.start_ns, r.end_ns,
        r.channel_messages);
  }
};

struct McapMetadata {
  std::string name;
  TextMap values;
  static constexpr Opcode kOpcode = Opcode::Metadata;
  static void fields(auto& r, auto use) { use(r.name, r.values); }
};

struct McapMetadataIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::string name;
  static constexpr Opcode kOpcode = Opcode::MetadataIndex;
  static void fields(auto& r, auto use) { use(r.offset, r.length, r.name); }
};

// The position of the records of one kind in the summary.
struct McapSummaryOffset {
  std::uint8_t opcode = 0;
  std::uint64_t start = 0;
  std::uint64_t length = 0;
  static constexpr Opcode kOpcode = Opcode::SummaryOffset;
  static void fields(auto& r, auto use) { use(r.opcode, r.start, r.length); }
};

struct McapDataEnd {
  std::uint32_t crc = 0;  // CRC of all bytes before this record
  static constexpr Opcode kOpcode = Opcode::DataEnd;
  static void fields(auto& r, auto use) { use(r.crc); }
};

}  // namespace indurop::recording
