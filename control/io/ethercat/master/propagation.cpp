// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/propagation.h"

#include <algorithm>

namespace indurop::io::ethercat {

namespace {

constexpr std::array<std::size_t, kPorts> kPortOrder = {0, 3, 1, 2};  // in which a frame passes them

// Returns the first open port after this one, both as places in kPortOrder; its size: there is none.
std::size_t next_open(const PortTimes& slave, std::size_t place) noexcept {
  ++place;
  while (place < kPortOrder.size() && !slave.is_open[kPortOrder[place]]) {
    ++place;
  }
  return place;
}

std::uint32_t arrival(const PortTimes& slave, std::size_t place) noexcept {
  return slave.arrival[kPortOrder[place]];
}

// Returns how long the frame was at the slave and beyond it.
std::uint32_t time_beyond(const PortTimes& slave) noexcept {
  std::size_t last = 0;
  for (std::size_t place = 0; place < kPortOrder.size(); place = next_open(slave, place)) {
    last = place;
  }
  return arrival(slave, last) - arrival(slave, 0);
}

}  // namespace

Propagation::Propagation(std::size_t slaves) {
  path_.reserve(slaves);
}

bool Propagation::find(std::span<const PortTimes> slaves, std::span<std::uint32_t> delays) noexcept {
  const auto enters_at_port_0 = [](const PortTimes& slave) { return slave.is_open[0]; };
  if (slaves.empty() || !std::all_of(slaves.begin(), slaves.end(), enters_at_port_0)) {
    return false;
  }
  path_.clear();
  path_.push_back({});
  delays[0] = 0;
  std::size_t next = 1;
  while (!path_.empty()) {
    Visit& here = path_.back();
    const PortTimes& parent = slaves[here.slave];
    const std::size_t exit = next_open(parent, here.port);
    if (exit == kPortOrder.size()) {
      path_.pop_back();
      continue;
    }
    if (next == slaves.size() || (!parent.has_clock && here.port != 0)) {
      return false;
    }
    Way way = here.way;
    if (parent.has_clock) {
      way.begin = delays[here.slave] + arrival(parent, here.port) - arrival(parent, 0);
      way.away = arrival(parent, exit) - arrival(parent, here.port);
      way.is_timed = true;
    }
    delays[next] = slaves[next].has_clock ? delay_at_end(way, slaves[next]) : way.begin;
    here.port = exit;
    path_.push_back({next, way, 0});
    ++next;
  }
  return next == slaves.size();
}

// Half of the time that the frame was away from the slave before, and not at this one or beyond it.
std::uint32_t Propagation::delay_at_end(const Way& way, const PortTimes& slave) noexcept {
  const auto both_ways = static_cast<std::int32_t>(way.away - time_beyond(slave));
  return way.is_timed ? way.begin + static_cast<std::uint32_t>(std::max(both_ways, 0) / 2) : 0;
}

}  // namespace indurop::io::ethercat
