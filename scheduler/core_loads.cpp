// SPDX-License-Identifier: Apache-2.0
#include "scheduler/core_loads.h"

#include <algorithm>

namespace indurop::scheduler {

CoreLoads::CoreLoads(int cores, std::int64_t ticks, std::int64_t basic_ns, std::int64_t tick_cost_ns)
    : ticks_(ticks),
      room_(std::max<std::int64_t>(basic_ns - tick_cost_ns, 1)),
      tick_cost_(tick_cost_ns),
      loads_(index(cores), std::vector<std::int64_t>(static_cast<std::size_t>(ticks))),
      busiest_(index(cores), tick_cost_ns) {}

void CoreLoads::apply(std::vector<std::int64_t>& load, const LoadUnit& unit, std::int64_t shift,
                      std::int64_t sign) const {
  for (const LoadUnit::Piece& piece : unit.work) {
    load[static_cast<std::size_t>((piece.tick + shift) % ticks_)] += sign * piece.ns;
  }
}

std::int64_t CoreLoads::longest(const std::vector<std::int64_t>& load) const {
  std::int64_t left = 0;
  std::int64_t most = 0;
  // Work left at the end of a macro period carries over into the next one.
  for (int round = 0; round < (ticks_ > 1 ? 2 : 1); ++round) {
    for (const std::int64_t added : load) {
      left = std::max<std::int64_t>(left - room_, 0) + added;
      most = std::max(most, left);
    }
  }
  return most + tick_cost_;
}

void CoreLoads::add(int core, const LoadUnit& unit, std::int64_t shift) {
  apply(loads_[index(core)], unit, shift, 1);
  busiest_[index(core)] = longest(loads_[index(core)]);
}

void CoreLoads::remove(int core, const LoadUnit& unit, std::int64_t shift) {
  apply(loads_[index(core)], unit, shift, -1);
  busiest_[index(core)] = longest(loads_[index(core)]);
}

std::int64_t CoreLoads::busiest() const {
  return *std::max_element(busiest_.begin(), busiest_.end());
}

std::int64_t CoreLoads::busiest_with(int core, const LoadUnit* unit, std::int64_t shift, const LoadUnit* gone,
                                     std::int64_t gone_shift) const {
  tried_ = loads_[index(core)];
  if (unit != nullptr) {
    apply(tried_, *unit, shift, 1);
  }
  if (gone != nullptr) {
    apply(tried_, *gone, gone_shift, -1);
  }
  return longest(tried_);
}

}  // namespace indurop::scheduler
