// SPDX-License-Identifier: Apache-2.0
#include "io/modbus_plan.h"

#include <algorithm>
#include <tuple>

namespace indurop::io {
namespace {

using config::IoPoint;

struct Limits {
  std::uint32_t bits;
  std::uint32_t registers;
  std::uint32_t gap;
};

std::uint32_t end_of(const IoPoint& point) {
  return point.address.number + config::registers_of(point.type);
}

std::vector<ModbusRequest> plan(std::span<const IoPoint> points, const Limits& limits) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  const auto key = [&](std::size_t i) {
    const IoPoint& p = points[i];
    return std::tuple(p.unit, p.address.table, p.address.number);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<ModbusRequest> requests;
  for (const std::size_t i : order) {
    const IoPoint& point = points[i];
    const std::uint32_t most = config::is_bits(point.address.table) ? limits.bits : limits.registers;
    ModbusRequest* last = requests.empty() ? nullptr : &requests.back();
    const std::uint32_t last_end = last != nullptr ? std::uint32_t{last->first} + last->count : 0;
    const bool joins = last != nullptr && last->unit == point.unit && last->table == point.address.table &&
                       point.address.number <= last_end + limits.gap && end_of(point) - last->first <= most;
    if (!joins) {
      requests.push_back({point.unit, point.address.table, point.address.number, 0, {}});
      last = &requests.back();
    }
    const std::uint32_t end = std::max(joins ? last_end : 0, end_of(point));
    last->count = static_cast<std::uint16_t>(end - last->first);
    last->points.push_back(i);
  }
  return requests;
}

}  // namespace

std::vector<ModbusRequest> plan_reads(std::span<const IoPoint> points, int gap) {
  return plan(points, {kMostReadBits, kMostReadRegisters, static_cast<std::uint32_t>(gap)});
}

std::vector<ModbusRequest> plan_writes(std::span<const IoPoint> points) {
  return plan(points, {kMostWrittenBits, kMostWrittenRegisters, 0});
}

}  // namespace indurop::io
