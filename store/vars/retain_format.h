// SPDX-License-Identifier: Apache-2.0
// The file of retained values: FileHeader, u32 length and text of the types (schema JSON), then one record per
// variable: RecordHeader, name, value.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/schema/schema.h"

namespace indurop::vars {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kRetainVersion = 2;

struct FileHeader {
  std::uint64_t magic;
  std::uint32_t version;
  std::uint32_t checksum;
  std::uint64_t sequence;  // the higher one is the newer
  std::uint64_t payload_size;
};

struct RecordHeader {
  std::uint64_t name_hash;
  std::uint64_t type_hash;
  std::uint32_t name_length;
  std::uint32_t value_size;
};

struct Record {
  RecordHeader header{};
  std::string name;
  std::span<const std::uint8_t> value;
};

// Text for people, empty if the copy is valid.
std::string damage_of(std::span<const std::uint8_t> bytes);

// Reads the types at the start of a payload and removes them; none of a file of `version` 1, or of a later schema.
schema::Schema take_types(std::uint32_t version, std::span<const std::uint8_t>& rest);

// Removes one record from `rest`. Returns false at the end, and at anything that cannot be a record.
bool next_record(std::span<const std::uint8_t>& rest, Record& record);

void append_types(Bytes& payload, const std::string& types);
void append_record(Bytes& payload, const Record& record);

// The whole file.
Bytes encode(std::uint64_t sequence, const Bytes& payload);

}  // namespace indurop::vars
