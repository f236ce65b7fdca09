// SPDX-License-Identifier: Apache-2.0
// The EEPROM of a slave (SII): who it is, its mailboxes, SyncManagers, FMMUs, PDOs and clock modes. Images come from
// other makers' devices: whatever the bytes are, the reader stays inside of them. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <vector>

#include "control/io/ethercat/bytes.h"

namespace indurop::io::ethercat {

struct Identity {
  std::uint32_t vendor = 0;
  std::uint32_t product = 0;
  std::uint32_t revision = 0;
  std::uint32_t serial = 0;
};
constexpr bool operator==(const Identity& a, const Identity& b) noexcept {
  return a.vendor == b.vendor && a.product == b.product && a.revision == b.revision && a.serial == b.serial;
}

struct MailboxArea {
  std::uint16_t receive_at = 0;  // the slave receives: master to slave
  std::uint16_t receive_size = 0;
  std::uint16_t send_at = 0;
  std::uint16_t send_size = 0;
};

// Bits of Sii::protocols.
inline constexpr std::uint16_t kProtocolAoe = 0x01;
inline constexpr std::uint16_t kProtocolEoe = 0x02;
inline constexpr std::uint16_t kProtocolCoe = 0x04;
inline constexpr std::uint16_t kProtocolFoe = 0x08;
inline constexpr std::uint16_t kProtocolSoe = 0x10;

// Bits of Sii::coe_details.
inline constexpr std::uint8_t kCoeSdo = 0x01;
inline constexpr std::uint8_t kCoeSdoInfo = 0x02;
inline constexpr std::uint8_t kCoePdoAssign = 0x04;
inline constexpr std::uint8_t kCoePdoConfiguration = 0x08;
inline constexpr std::uint8_t kCoePdoUpload = 0x10;
inline constexpr std::uint8_t kCoeCompleteAccess = 0x20;

enum class FmmuUse : std::uint8_t { None = 0, Outputs = 1, Inputs = 2, MailboxState = 3, Unused = 0xFF };
enum class SyncManagerUse : std::uint8_t { None = 0, MailboxOut = 1, MailboxIn = 2, Outputs = 3, Inputs = 4 };

struct SyncManagerEntry {
  std::uint16_t start = 0;
  std::uint16_t length = 0;
  std::uint8_t control = 0;
  std::uint8_t enable = 0;
  SyncManagerUse use = SyncManagerUse::None;
};

struct PdoEntry {
  std::uint16_t index = 0;  // 0: a gap
  std::uint8_t subindex = 0;
  std::uint8_t bits = 0;
  std::uint8_t type = 0;  // as CoE numbers its data types
  std::string name;
};
constexpr bool is_object(const PdoEntry& entry, std::uint16_t index, std::uint8_t subindex) noexcept {
  return entry.index == index && entry.subindex == subindex;
}

inline constexpr std::uint8_t kNotAssigned = 0xFF;
// Bits of Pdo::flags.
inline constexpr std::uint16_t kPdoMandatory = 0x0001;
inline constexpr std::uint16_t kPdoFixed = 0x0010;  // what it contains

struct Pdo {
  std::uint16_t index = 0;
  std::uint8_t sync_manager = kNotAssigned;
  std::uint16_t flags = 0;
  std::string name;
  std::vector<PdoEntry> entries;
  std::vector<std::uint16_t> excludes{};  // PDOs that cannot be assigned with it; an EEPROM does not say so
};
// The sum of the entries.
std::size_t bits_of(const Pdo& pdo) noexcept;
// The entry that is this object; null if there is none.
const PdoEntry* find_entry(const Pdo& pdo, std::uint16_t index, std::uint8_t subindex) noexcept;

struct ClockMode {
  std::string name;
  std::uint16_t assign_activate = 0;
  std::uint32_t cycle0 = 0;  // ns; 0: that of the bus
  std::uint32_t shift0 = 0;  // ns
  std::uint32_t shift1 = 0;  // ns
  std::int16_t factor0 = 0;
  std::int16_t factor1 = 0;
};

struct Sii {
  bool checksum_fits = false;  // that of the first seven words
  std::uint16_t pdi_control = 0;
  std::uint16_t alias = 0;
  Identity identity;
  MailboxArea bootstrap;
  MailboxArea mailbox;
  std::uint16_t protocols = 0;
  std::string group;
  std::string image;
  std::string order;
  std::string name;
  std::uint8_t coe_details = 0;
  bool no_lrw = false;                 // its process data needs LRD and LWR
  std::int16_t ebus_milliamperes = 0;  // what it draws; negative: what it supplies
  std::vector<std::string> strings;    // [0] is number 1
  std::vector<FmmuUse> fmmus;
  std::vector<SyncManagerEntry> sync_managers;
  std::vector<Pdo> inputs;   // TxPDOs
  std::vector<Pdo> outputs;  // RxPDOs
  std::vector<ClockMode> clocks;
};

// The first SyncManager that is used so; kNotAssigned if there is none.
std::uint8_t first_manager(const Sii& sii, SyncManagerUse use) noexcept;

// Words of the fixed part, where the categories begin.
inline constexpr std::uint16_t kSiiIdentity = 0x0008;
inline constexpr std::uint16_t kSiiCategories = 0x0040;
// Numbers of categories.
inline constexpr std::uint16_t kSiiNop = 0;
inline constexpr std::uint16_t kSiiStrings = 10;
inline constexpr std::uint16_t kSiiGeneral = 30;
inline constexpr std::uint16_t kSiiFmmus = 40;
inline constexpr std::uint16_t kSiiSyncManagers = 41;
inline constexpr std::uint16_t kSiiTxPdos = 50;
inline constexpr std::uint16_t kSiiRxPdos = 51;
inline constexpr std::uint16_t kSiiClocks = 60;
inline constexpr std::uint16_t kSiiEnd = 0xFFFF;
// Flags of the category General.
inline constexpr std::size_t kSiiFlagsAt = 11;
inline constexpr std::uint8_t kSiiNoLrw = 0x02;

// The checksum that belongs into word 7 of an image.
std::uint8_t sii_checksum(Bytes image) noexcept;

// Reads a whole image. Errors say at which word the image is broken.
Result<Sii, std::string> read_sii(Bytes image);

}  // namespace indurop::io::ethercat
