// SPDX-License-Identifier: Apache-2.0
#include "control/io/modbus_plan.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace indurop::io {
namespace {

using config::IoPoint;

struct Limits {
  std::uint32_t bits;
  std::uint32_t registers;
  std::uint32_t gap;
};

// A read takes the whole register for any of its bits; a write only the bits.
std::vector<ModbusRequest> plan(std::span<const IoPoint> points, const Limits& limits, bool writing) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  const auto masked = [&](const IoPoint& p) { return writing && p.address.bit >= 0; };
  const auto key = [&](std::size_t i) {
    const IoPoint& p = points[i];
    return std::tuple(p.unit, p.every, masked(p), p.address.table, p.address.number);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<ModbusRequest> requests;
  for (const std::size_t i : order) {
    const IoPoint& point = points[i];
    const std::uint32_t most = config::is_bits(point.address.table) ? limits.bits : limits.registers;
    ModbusRequest* last = requests.empty() ? nullptr : &requests.back();
    const std::uint32_t last_end = last != nullptr ? std::uint32_t{last->first} + last->count : 0;
    const bool joins =
        last != nullptr && last->unit == point.unit && last->every == point.every && last->masked == masked(point) &&
        last->table == point.address.table &&
        (masked(point) ? point.address.number == last->first : point.address.number <= last_end + limits.gap) &&
        end_of(point) - last->first <= most;
    if (!joins) {
      requests.push_back({point.unit, point.address.table, point.address.number, 0, {}, point.every, masked(point)});
      last = &requests.back();
    }
    const std::uint32_t end = std::max(joins ? last_end : 0, end_of(point));
    last->count = static_cast<std::uint16_t>(end - last->first);
    last->points.push_back(i);
  }
  return requests;
}

}  // namespace

std::uint32_t end_of(const IoPoint& point) noexcept {
  return point.address.number + config::registers_of(point.type);
}

std::vector<ModbusRequest> plan_reads(std::span<const IoPoint> points, int gap) {
  return plan(points, {kMaxReadBits, kMaxReadRegisters, static_cast<std::uint32_t>(gap)}, false);
}

std::vector<ModbusRequest> plan_writes(std::span<const IoPoint> points) {
  return plan(points, {kMaxWrittenBits, kMaxWrittenRegisters, 0}, true);
}

std::vector<ModbusStep> plan_steps(std::vector<ModbusRequest> writes, std::vector<ModbusRequest> reads, bool together) {
  std::vector<ModbusStep> steps;
  for (ModbusRequest& write : writes) {
    ModbusStep& step = steps.emplace_back(ModbusStep{std::move(write), {}});
    if (!together || step.write.masked || step.write.table != config::IoTable::Holding ||
        step.write.count > kMaxExchangedRegisters) {
      continue;
    }
    const auto found = std::find_if(reads.begin(), reads.end(), [&](const ModbusRequest& read) {
      return read.table == config::IoTable::Holding && read.unit == step.write.unit && read.every == step.write.every;
    });
    if (found != reads.end()) {
      step.read = std::move(*found);
      reads.erase(found);
    }
  }
  for (ModbusRequest& read : reads) {
    steps.push_back({{}, std::move(read)});
  }
  return steps;
}

}  // namespace indurop::io
