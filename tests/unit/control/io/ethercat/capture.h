// SPDX-License-Identifier: Apache-2.0
// The packets of a capture file (pcapng), in their order.

#pragma once

#include <vector>

#include "control/io/ethercat/bytes.h"
#include "real_data.h"

namespace indurop::io::ethercat {

inline std::vector<std::vector<std::uint8_t>> packets_of(const std::filesystem::path& path) {
  constexpr std::uint32_t kEnhancedPacket = 6;
  constexpr std::size_t kPacketHeader = 28;
  std::vector<std::vector<std::uint8_t>> packets;
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
      packets.emplace_back(packet.begin(), packet.end());
    }
    at += size;
  }
  return packets;
}

}  // namespace indurop::io::ethercat
