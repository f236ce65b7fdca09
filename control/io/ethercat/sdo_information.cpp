// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/sdo_information.h"

#include <algorithm>

namespace indurop::io::ethercat {

namespace {

constexpr std::size_t kOpcodeAt = 2;
constexpr std::size_t kFragmentsAt = 4;
constexpr std::size_t kHeader = 6;
constexpr std::uint8_t kIncomplete = 0x80;
constexpr std::size_t kObjectBytes = 6;  // before its name
constexpr std::size_t kEntryBytes = 10;  // before its name

std::string text_of(Bytes bytes) {
  const auto end = std::find(bytes.begin(), bytes.end(), std::uint8_t{0});
  return {bytes.begin(), end};
}

}  // namespace

std::optional<Information> read_information(Bytes message) noexcept {
  constexpr unsigned kServiceShift = 12;
  if (message.size() < kHeader ||
      load<std::uint16_t>(message, 0) >> kServiceShift != static_cast<unsigned>(CoeService::SdoInformation)) {
    return std::nullopt;
  }
  const std::uint8_t code = message[kOpcodeAt];
  return Information{static_cast<InformationCode>(code & ~unsigned{kIncomplete}), (code & kIncomplete) != 0,
                     message.subspan(kHeader)};
}

std::vector<std::vector<std::uint8_t>> write_information(InformationCode code, Bytes data, std::size_t room) {
  std::vector<std::vector<std::uint8_t>> fragments;
  const std::size_t most = room - kHeader;
  auto left = static_cast<std::uint16_t>(data.empty() ? 0 : (data.size() - 1) / most);
  for (;; --left) {
    const Bytes part = data.first(std::min(data.size(), most));
    data = data.subspan(part.size());
    std::vector<std::uint8_t> bytes(kHeader);
    constexpr unsigned kServiceShift = 12;
    store<std::uint16_t>(
        bytes, 0, static_cast<std::uint16_t>(static_cast<unsigned>(CoeService::SdoInformation) << kServiceShift));
    bytes[kOpcodeAt] = static_cast<std::uint8_t>(static_cast<unsigned>(code) | (left > 0 ? kIncomplete : 0U));
    store<std::uint16_t>(bytes, kFragmentsAt, left);
    bytes.insert(bytes.end(), part.begin(), part.end());
    fragments.push_back(std::move(bytes));
    if (left == 0) {
      return fragments;
    }
  }
}

std::vector<std::uint8_t> write_object(const ObjectDescription& object) {
  std::vector<std::uint8_t> bytes(kObjectBytes);
  store<std::uint16_t>(bytes, 0, object.index);
  store<std::uint16_t>(bytes, 2, object.type);
  bytes[4] = object.last_subindex;
  bytes[5] = static_cast<std::uint8_t>(object.code);
  bytes.insert(bytes.end(), object.name.begin(), object.name.end());
  return bytes;
}

std::optional<ObjectDescription> read_object(Bytes data) {
  if (data.size() < kObjectBytes) {
    return std::nullopt;
  }
  return ObjectDescription{load<std::uint16_t>(data, 0), load<std::uint16_t>(data, 2), data[4],
                           static_cast<ObjectCode>(data[5]), text_of(data.subspan(kObjectBytes))};
}

std::vector<std::uint8_t> write_entry(const EntryDescription& entry) {
  std::vector<std::uint8_t> bytes(kEntryBytes);
  store<std::uint16_t>(bytes, 0, entry.index);
  bytes[2] = entry.subindex;  // the byte after it says which values follow: none
  store<std::uint16_t>(bytes, 4, entry.type);
  store<std::uint16_t>(bytes, 6, entry.bits);
  store<std::uint16_t>(bytes, 8, entry.access);
  bytes.insert(bytes.end(), entry.name.begin(), entry.name.end());
  return bytes;
}

std::optional<EntryDescription> read_entry(Bytes data) {
  if (data.size() < kEntryBytes) {
    return std::nullopt;
  }
  return EntryDescription{load<std::uint16_t>(data, 0), data[2],
                          load<std::uint16_t>(data, 4), load<std::uint16_t>(data, 6),
                          load<std::uint16_t>(data, 8), text_of(data.subspan(kEntryBytes))};
}

}  // namespace indurop::io::ethercat
