// SPDX-License-Identifier: Apache-2.0
// Combines the points of a Modbus device into as few requests as the protocol allows: adjacent points share a request.
// Pure functions.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "config/model/io_config.h"

namespace indurop::io {

struct ModbusRequest {
  int unit = 1;
  config::IoTable table = config::IoTable::Holding;
  std::uint16_t first = 0;
  std::uint16_t count = 0;
  std::vector<std::size_t> points;  // indices, sorted by address
  int every = 1;                    // made in every n-th exchange
  bool masked = false;              // writes single bits of one register
};

// The address after the last one of a point.
std::uint32_t end_of(const config::IoPoint& point) noexcept;

// Limits of one request in the protocol.
inline constexpr std::uint32_t kMaxReadRegisters = 125;
inline constexpr std::uint32_t kMaxWrittenRegisters = 123;
inline constexpr std::uint32_t kMaxExchangedRegisters = 121;  // written in a request that also reads
inline constexpr std::uint32_t kMaxReadBits = 2000;
inline constexpr std::uint32_t kMaxWrittenBits = 1968;

// A read request may include up to `gap` unused places between two points. A write request never includes unused
// places.
std::vector<ModbusRequest> plan_reads(std::span<const config::IoPoint> points, int gap);
std::vector<ModbusRequest> plan_writes(std::span<const config::IoPoint> points);

// One request and answer on the wire: a write, a read, or both at once (function 23).
struct ModbusStep {
  ModbusRequest write;  // count 0: none
  ModbusRequest read;
};
// Puts writes before reads. `together`: a write of holding registers is combined with a read of holding registers.
std::vector<ModbusStep> plan_steps(std::vector<ModbusRequest> writes, std::vector<ModbusRequest> reads, bool together);

}  // namespace indurop::io
