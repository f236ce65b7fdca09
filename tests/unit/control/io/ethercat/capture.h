// SPDX-License-Identifier: Apache-2.0
// The packets of a capture file (pcapng), in their order.

#pragma once

#include <chrono>
#include <vector>

#include "control/io/ethercat/bytes.h"
#include "real_data.h"

namespace indurop::io::ethercat {

struct Packet {
  std::chrono::microseconds at{0};
  std::vector<std::uint8_t> bytes;
};

inline bool is_ethercat(Bytes packet) {
  constexpr std::size_t kLeast = 16;
  return packet.size() >= kLeast && packet[12] == 0x88 && packet[13] == 0xA4;
}

inline std::vector<Packet> packets_of(const std::filesystem::path& path) {
  constexpr std::uint32_t kEnhancedPacket = 6;
  constexpr std::size_t kPacketHeader = 28;
  std::vector<Packet> packets;
  const auto file = bytes_of_file(path);
  std::size_t at = 0;
  while (at + 12 <= file.size()) {
    const auto type = load<std::uint32_t>(file, at);
    const std::size_t size = load<std::uint32_t>(file, at + 4);
    if (size < 12 || size > file.size() - at) {
      ADD_FAILURE() << path << ": block at " << at << " has " << size << " bytes";
      break;
    }
    if (type == kEnhancedPacket) {
      const std::size_t length = load<std::uint32_t>(file, at + 20);
      const auto packet = Bytes(file).subspan(at + kPacketHeader, length);
      const auto time = std::uint64_t{load<std::uint32_t>(file, at + 12)} << 32U | load<std::uint32_t>(file, at + 16);
      packets.push_back({std::chrono::microseconds(static_cast<std::int64_t>(time)), {packet.begin(), packet.end()}});
    }
    at += size;
  }
  return packets;
}

}  // namespace indurop::io::ethercat
