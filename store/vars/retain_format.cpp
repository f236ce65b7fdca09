// SPDX-License-Identifier: Apache-2.0
#include "store/vars/retain_format.h"

#include <algorithm>
#include <cstring>

#include "store/vars/crc32c.h"

namespace indurop::vars {

namespace {

constexpr std::uint64_t kRetainMagic = 0x3154455255444e49ULL;  // "INDURET1"
constexpr std::uint32_t kWithoutTypes = 1;                     // still readable
constexpr std::size_t kChecked = 16;                           // the checksum covers everything from this offset on
static_assert(sizeof(FileHeader) == 32 && offsetof(FileHeader, sequence) == kChecked);

void append(Bytes& to, const void* from, std::size_t size) {
  const auto* at = static_cast<const std::uint8_t*>(from);
  to.insert(to.end(), at, at + size);
}

}  // namespace

std::string damage_of(std::span<const std::uint8_t> bytes) {
  FileHeader header{};
  if (bytes.size() < sizeof(header)) {
    return "cut off";
  }
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (header.magic != kRetainMagic) {
    return "not a file of retained values";
  }
  if (header.version != kRetainVersion && header.version != kWithoutTypes) {
    return "written by another version of InduRoP";
  }
  if (header.payload_size != bytes.size() - sizeof(header)) {
    return "cut off";
  }
  return header.checksum == crc32c(bytes.subspan(kChecked)) ? "" : "checksum is wrong";
}

schema::Schema take_types(std::uint32_t version, std::span<const std::uint8_t>& rest) {
  std::uint32_t length = 0;
  if (version == kWithoutTypes || rest.size() < sizeof length) {
    return {};
  }
  std::memcpy(&length, rest.data(), sizeof length);
  rest = rest.subspan(sizeof length);
  length = static_cast<std::uint32_t>(std::min<std::size_t>(length, rest.size()));
  auto types = schema::from_json({reinterpret_cast<const char*>(rest.data()), length});
  rest = rest.subspan(length);
  return types ? std::move(types).value() : schema::Schema{};  // another version: only equal types are restored
}

bool next_record(std::span<const std::uint8_t>& rest, Record& record) {
  if (rest.size() < sizeof(RecordHeader)) {
    return false;
  }
  std::memcpy(&record.header, rest.data(), sizeof(RecordHeader));
  rest = rest.subspan(sizeof(RecordHeader));
  const std::uint64_t size = std::uint64_t{record.header.name_length} + record.header.value_size;
  if (size > rest.size()) {
    return false;
  }
  record.name.assign(reinterpret_cast<const char*>(rest.data()), record.header.name_length);
  record.value = rest.subspan(record.header.name_length, record.header.value_size);
  rest = rest.subspan(size);
  return true;
}

void append_types(Bytes& payload, const std::string& types) {
  const auto length = static_cast<std::uint32_t>(types.size());
  append(payload, &length, sizeof length);
  append(payload, types.data(), types.size());
}

void append_record(Bytes& payload, const Record& record) {
  append(payload, &record.header, sizeof(record.header));
  append(payload, record.name.data(), record.name.size());
  append(payload, record.value.data(), record.value.size());
}

Bytes encode(std::uint64_t sequence, const Bytes& payload) {
  FileHeader header{kRetainMagic, kRetainVersion, 0, sequence, payload.size()};
  Bytes bytes;
  bytes.reserve(sizeof(header) + payload.size());
  append(bytes, &header, sizeof(header));
  append(bytes, payload.data(), payload.size());
  header.checksum = crc32c(std::span(bytes).subspan(kChecked));
  std::memcpy(bytes.data(), &header, sizeof(header));
  return bytes;
}

}  // namespace indurop::vars
