// SPDX-License-Identifier: Apache-2.0
// Mailbox messages, and CANopen over EtherCAT (CoE) inside of them: what both sides of the wire share.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "control/io/ethercat/bytes.h"

namespace indurop::io::ethercat {

enum class MailboxType : std::uint8_t { Error = 0, Aoe = 1, Eoe = 2, Coe = 3, Foe = 4, Soe = 5 };
enum class CoeService : std::uint8_t { Emergency = 1, SdoRequest = 2, SdoResponse = 3, SdoInformation = 8 };

inline constexpr std::size_t kMailboxHeader = 6;
inline constexpr std::size_t kCoeHeader = kMailboxHeader + 2;
inline constexpr std::size_t kSdoHeader = kCoeHeader + 8;  // command, index, subindex, four bytes
inline constexpr std::size_t kSegmentHeader = kCoeHeader + 1;
inline constexpr std::uint8_t kLastCounter = 7;  // they count from 1; 0 is "not counted"

struct Mailbox {
  MailboxType type = MailboxType::Error;
  std::uint8_t counter = 0;
  Bytes data;  // after its header
};

// Writes the header of a message with `size` bytes after it.
void write_mailbox_header(std::span<std::uint8_t> to, std::size_t size, MailboxType type,
                          std::uint8_t counter) noexcept;
void write_coe_header(std::span<std::uint8_t> to, CoeService service) noexcept;
// Nothing if the message is longer than the bytes.
std::optional<Mailbox> read_mailbox(Bytes bytes) noexcept;
// The service of a CoE message; nothing if it is too short.
std::optional<CoeService> service_of(const Mailbox& mailbox) noexcept;

constexpr std::uint8_t next_counter(std::uint8_t counter) noexcept {
  return counter == kLastCounter ? std::uint8_t{1} : static_cast<std::uint8_t>(counter + 1);
}

// The first byte of an SDO: command and flags. The segment's toggle is the same bit as "complete access".
inline constexpr std::uint8_t kSdoCommandMask = 0xE0;
inline constexpr std::uint8_t kSdoDownload = 0x20;  // request; the answer to a segment of a download, too
inline constexpr std::uint8_t kSdoUpload = 0x40;    // request and answer
inline constexpr std::uint8_t kSdoDownloaded = 0x60;
inline constexpr std::uint8_t kSdoUploadSegment = 0x60;  // request
inline constexpr std::uint8_t kSdoAbort = 0x80;
inline constexpr std::uint8_t kSdoComplete = 0x10;
inline constexpr std::uint8_t kSdoToggle = 0x10;
inline constexpr std::uint8_t kSdoExpedited = 0x02;
inline constexpr std::uint8_t kSdoSized = 0x01;
inline constexpr std::uint8_t kSdoLast = 0x01;  // no segment follows
inline constexpr std::size_t kMinSegment = 7;   // a shorter one says how many of the seven are unused

// Reasons to abort that this tree itself gives; sdo_abort_text() knows all that are published.
inline constexpr std::uint32_t kAbortToggle = 0x05030000;
inline constexpr std::uint32_t kAbortTimeout = 0x05040000;
inline constexpr std::uint32_t kAbortCommand = 0x05040001;
inline constexpr std::uint32_t kAbortMemory = 0x05040005;
inline constexpr std::uint32_t kAbortUnsupported = 0x06010000;
inline constexpr std::uint32_t kAbortReadOnly = 0x06010002;
inline constexpr std::uint32_t kAbortNotEmpty = 0x06010003;
inline constexpr std::uint32_t kAbortNoObject = 0x06020000;
inline constexpr std::uint32_t kAbortNotMappable = 0x06040041;
inline constexpr std::uint32_t kAbortPdoLength = 0x06040042;
inline constexpr std::uint32_t kAbortIncompatible = 0x06040043;
inline constexpr std::uint32_t kAbortLength = 0x06070010;
inline constexpr std::uint32_t kAbortNoSubindex = 0x06090011;
inline constexpr std::uint32_t kAbortRange = 0x06090030;
inline constexpr std::uint32_t kAbortTooHigh = 0x06090031;
inline constexpr std::uint32_t kAbortState = 0x08000022;
std::string_view sdo_abort_text(std::uint32_t code) noexcept;

// The objects of a SyncManager's PDOs, from this index on.
inline constexpr std::uint16_t kPdoAssignment = 0x1C10;

struct Emergency {
  std::uint16_t code = 0;
  std::uint8_t error_register = 0;
  std::array<std::uint8_t, 5> data{};
};

}  // namespace indurop::io::ethercat
