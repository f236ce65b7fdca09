// SPDX-License-Identifier: Apache-2.0
// EtherCAT frames: datagrams after one Ethernet header. Built in a fixed buffer, read in place; bytes from the wire
// are trusted in nothing. Real-time safe.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "control/io/ethercat/bytes.h"

namespace indurop::io::ethercat {

enum class Command : std::uint8_t {
  Nop = 0,
  Aprd = 1,  // A: by position, each slave counts up
  Apwr = 2,
  Aprw = 3,
  Fprd = 4,  // F: by the configured station address
  Fpwr = 5,
  Fprw = 6,
  Brd = 7,  // B: all slaves; what they read is combined by OR
  Bwr = 8,
  Brw = 9,
  Lrd = 10,  // L: logical address, through the FMMUs
  Lwr = 11,
  Lrw = 12,
  Armw = 13,  // one slave reads, the others write
  Frmw = 14
};
inline constexpr std::uint8_t kLastCommand = 14;

std::string_view to_string(Command command) noexcept;

constexpr bool is_logical(Command command) noexcept {
  return command == Command::Lrd || command == Command::Lwr || command == Command::Lrw;
}

// The address of a slave's register: position or station in the low half, register in the high one, as on the wire.
constexpr std::uint32_t address_of(std::uint16_t slave, std::uint16_t offset) noexcept {
  return static_cast<std::uint32_t>(offset) << 16U | slave;
}
// The position of a slave as a datagram has it: it arrives as 0.
constexpr std::uint16_t position(std::size_t index) noexcept {
  return static_cast<std::uint16_t>(0U - static_cast<unsigned>(index));
}

inline constexpr std::size_t kEthernetHeader = 14;
inline constexpr std::size_t kFrameHeader = kEthernetHeader + 2;
inline constexpr std::size_t kDatagramHeader = 10;
inline constexpr std::size_t kDatagramOverhead = kDatagramHeader + 2;  // with the working counter
inline constexpr std::size_t kMinFrame = 60;
inline constexpr std::size_t kMaxFrame = 1514;
inline constexpr std::size_t kMaxData = kMaxFrame - kFrameHeader - kDatagramOverhead;

struct Datagram {
  Command command = Command::Nop;
  std::uint8_t index = 0;
  std::uint32_t address = 0;
  std::uint16_t length = 0;
  bool circulating = false;  // passed a slave whose line to the master is cut
  std::uint16_t interrupt = 0;
  std::uint16_t wkc = 0;
  std::size_t at = 0;  // of its header in the frame

  [[nodiscard]] std::size_t data_at() const noexcept { return at + kDatagramHeader; }
  [[nodiscard]] std::size_t wkc_at() const noexcept { return data_at() + length; }
  [[nodiscard]] Bytes data(Bytes frame) const noexcept { return frame.subspan(data_at(), length); }
};

using Mac = std::array<std::uint8_t, 6>;

class FrameBuilder {
 public:
  explicit FrameBuilder(const Mac& source) noexcept;

  // Begins the next frame.
  void clear() noexcept;
  // Appends a datagram with this data; with none and a length: with zeros, for the slaves to fill. Returns where its
  // data begins in the frame, nothing if there is no room.
  std::optional<std::size_t> add(Command command, std::uint8_t index, std::uint32_t address, Bytes data) noexcept;
  std::optional<std::size_t> add(Command command, std::uint8_t index, std::uint32_t address,
                                 std::size_t length) noexcept;
  // Replaces data of a datagram, from where add() said it begins.
  void fill(std::size_t data_at, Bytes data) noexcept;
  [[nodiscard]] bool is_empty() const noexcept { return end_ == kFrameHeader; }
  // The bytes to send, padded to what Ethernet needs.
  [[nodiscard]] Bytes finish() noexcept;

 private:
  std::array<std::uint8_t, kMaxFrame> bytes_{};
  std::size_t end_ = kFrameHeader;
  std::size_t last_ = 0;  // header of the last datagram
};

enum class FrameFault {
  None,
  NotEtherCat,  // too short for a header, or of another EtherType
  NoCommands,   // the type is that of network variables or of a mailbox gateway
  TooShort,     // the header promises more bytes than there are
  NoDatagram,
  BrokenDatagram  // a length beyond the frame, an unknown command, a chain without an end
};

std::string_view to_string(FrameFault fault) noexcept;

// Reads datagrams one by one. A frame with any fault has none.
class FrameReader {
 public:
  explicit FrameReader(Bytes frame) noexcept;
  [[nodiscard]] FrameFault fault() const noexcept { return fault_; }
  bool next(Datagram& datagram) noexcept;

 private:
  [[nodiscard]] FrameFault walk() noexcept;

  Bytes frame_;
  std::size_t end_ = 0;  // of the last datagram
  std::size_t at_ = kFrameHeader;
  FrameFault fault_ = FrameFault::None;
};

}  // namespace indurop::io::ethercat
