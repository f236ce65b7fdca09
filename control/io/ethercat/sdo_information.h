// SPDX-License-Identifier: Apache-2.0
// SDO information: how a slave describes the objects it has (ETG.1000.6, 5.6.3). What both sides of the wire share. A
// message is what follows the mailbox header. Not real-time safe.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "control/io/ethercat/coe.h"

namespace indurop::io::ethercat {

enum class InformationCode : std::uint8_t {
  ListRequest = 1,  // type of list
  List = 2,         // type of list, indices; in several fragments if it is long
  ObjectRequest = 3,
  Object = 4,
  EntryRequest = 5,
  Entry = 6,
  Error = 7  // abort code
};
inline constexpr std::uint16_t kAllObjects = 1;  // type of list

struct Information {
  InformationCode code{};
  bool is_incomplete = false;  // more fragments follow
  Bytes data;                  // after its header
};
// Nothing if it is too short, or no SDO information.
std::optional<Information> read_information(Bytes message) noexcept;
// A message, in as many fragments as an answer of at most `room` bytes needs.
std::vector<std::vector<std::uint8_t>> write_information(InformationCode code, Bytes data, std::size_t room);

enum class ObjectCode : std::uint8_t { Variable = 7, Array = 8, Record = 9 };
struct ObjectDescription {
  std::uint16_t index = 0;
  std::uint16_t type = 0;  // as CoE numbers them
  std::uint8_t last_subindex = 0;
  ObjectCode code = ObjectCode::Variable;
  std::string name;
};
std::vector<std::uint8_t> write_object(const ObjectDescription& object);
std::optional<ObjectDescription> read_object(Bytes data);

// Bits of the access to an entry.
inline constexpr std::uint16_t kEntryReadable = 0x07;    // in PREOP, SAFEOP, OP
inline constexpr std::uint16_t kEntryWritable = 0x38;    // in PREOP, SAFEOP, OP
inline constexpr std::uint16_t kEntryForOutputs = 0x40;  // can be mapped to an RxPDO
inline constexpr std::uint16_t kEntryForInputs = 0x80;   // to a TxPDO
struct EntryDescription {
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  std::uint16_t type = 0;
  std::uint16_t bits = 0;
  std::uint16_t access = 0;
  std::string name;
};
std::vector<std::uint8_t> write_entry(const EntryDescription& entry);
std::optional<EntryDescription> read_entry(Bytes data);

}  // namespace indurop::io::ethercat
