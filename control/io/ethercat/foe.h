// SPDX-License-Identifier: Apache-2.0
// File access over EtherCAT (FoE, ETG.1000.6, 5.8): what both sides of the wire share. A message is what follows the
// mailbox header. Not real-time safe.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/io/ethercat/bytes.h"

namespace indurop::io::ethercat {

enum class FoeCode : std::uint8_t { Read = 1, Write = 2, Data = 3, Acknowledge = 4, Error = 5, Busy = 6 };

struct Foe {
  FoeCode code{};
  std::uint32_t number = 0;  // password, packet or error; of Busy: done and entire, 16 bits each
  Bytes data;                // of a packet; of the others a text
};
inline constexpr std::size_t kFoeHeader = 6;  // operation, reserved, number

// Nothing if it is too short.
std::optional<Foe> read_foe(Bytes message) noexcept;
std::vector<std::uint8_t> write_foe(FoeCode code, std::uint32_t number, Bytes data = {});
std::vector<std::uint8_t> write_foe(FoeCode code, std::uint32_t number, std::string_view text);

inline constexpr std::uint32_t kFoeNotFound = 0x8001;
inline constexpr std::uint32_t kFoeAccess = 0x8002;
inline constexpr std::uint32_t kFoeFull = 0x8003;
inline constexpr std::uint32_t kFoePacket = 0x8005;
inline constexpr std::uint32_t kFoeBootOnly = 0x8008;
std::string_view foe_error_text(std::uint32_t code) noexcept;

}  // namespace indurop::io::ethercat
