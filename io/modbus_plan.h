// SPDX-License-Identifier: Apache-2.0
// Points of a Modbus device gathered into as few requests as the protocol allows: neighbours travel together. Pure.

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
  std::vector<std::size_t> points;  // indices, by address
  int every = 1;                    // made in every so many exchanges
  bool masked = false;              // a writing of single bits of one register
};

// Limits of one request as the protocol has them.
inline constexpr std::uint32_t kMostReadRegisters = 125;
inline constexpr std::uint32_t kMostWrittenRegisters = 123;
inline constexpr std::uint32_t kMostExchangedRegisters = 121;  // written while others are read
inline constexpr std::uint32_t kMostReadBits = 2000;
inline constexpr std::uint32_t kMostWrittenBits = 1968;

// Up to `gap` places between two points may be read along. Nothing is ever written that is no point.
std::vector<ModbusRequest> plan_reads(std::span<const config::IoPoint> points, int gap);
std::vector<ModbusRequest> plan_writes(std::span<const config::IoPoint> points);

// What goes over the wire in one question and answer: a writing, a reading, or both at once (function 23).
struct ModbusStep {
  ModbusRequest write;  // counts 0: none
  ModbusRequest read;
};
// Writings before readings. `together`: a writing of holding registers takes a reading of such along.
std::vector<ModbusStep> plan_steps(std::vector<ModbusRequest> writes, std::vector<ModbusRequest> reads, bool together);

}  // namespace indurop::io
