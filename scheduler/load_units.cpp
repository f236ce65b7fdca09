// SPDX-License-Identifier: Apache-2.0
#include "scheduler/load_units.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kMaxTicks = 4096;  // with more ticks, all are treated as released at once
constexpr std::int64_t kMaxShifts = 64;   // shifts tried for one unit

std::int64_t macro_ticks(const PlacementProblem& problem) {
  std::int64_t macro = 1;
  for (const Placeable& module : problem.modules) {
    macro = macro > kMaxTicks ? macro : std::lcm(macro, module.period / problem.basic_period);
  }
  return macro > kMaxTicks ? 1 : macro;
}

std::uint32_t root_of(std::vector<std::uint32_t>& first, std::uint32_t module) {
  while (first[module] != module) {
    module = first[module] = first[first[module]];
  }
  return module;
}
void join(std::vector<std::uint32_t>& first, std::uint32_t a, std::uint32_t b) {
  first[std::max(root_of(first, a), root_of(first, b))] = std::min(root_of(first, a), root_of(first, b));
}

}  // namespace

LoadUnits::LoadUnits(const PlacementProblem& problem, bool move_offsets)
    : problem_(problem), ticks_(macro_ticks(problem)) {
  std::vector<std::uint32_t> first(problem.modules.size());
  std::iota(first.begin(), first.end(), 0U);
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    for (const std::uint32_t other : problem.modules[i].shares) {
      join(first, i, other);
    }
  }
  std::vector<std::size_t> unit_of(first.size(), first.size());
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    const std::uint32_t root = root_of(first, i);
    if (unit_of[root] == first.size()) {
      unit_of[root] = units_.size();
      units_.emplace_back();
    }
    units_[unit_of[root]].modules.push_back(i);
  }
  for (LoadUnit& unit : units_) {
    complete(unit, move_offsets);
  }
  std::stable_sort(units_.begin(), units_.end(), [](const LoadUnit& a, const LoadUnit& b) {
    return a.largest != b.largest ? a.largest > b.largest : a.weight > b.weight;
  });
}

void LoadUnits::complete(LoadUnit& unit, bool move_offsets) const {
  std::vector<std::int64_t> load(static_cast<std::size_t>(ticks_));
  bool may_move = move_offsets && ticks_ > 1;
  unit.period = std::numeric_limits<std::int64_t>::max();
  for (const std::uint32_t i : unit.modules) {
    const Placeable& module = problem_.modules[i];
    const std::int64_t period = module.period / problem_.basic_period;
    const std::int64_t cost = period > 1 ? problem_.cost.wake.count() : 0;
    may_move = may_move && !module.keeps_offset && module.offset == Nanos::zero();
    unit.core = module.core >= 0 ? module.core : unit.core;
    unit.period = std::min(unit.period, period);
    for (std::int64_t tick = module.offset / problem_.basic_period % ticks_; tick < ticks_; tick += period) {
      load[static_cast<std::size_t>(tick)] += module.execution.count() + cost;
    }
  }
  unit.shifts = may_move ? std::min(unit.period, kMaxShifts) : 1;
  for (std::int64_t tick = 0; tick < ticks_; ++tick) {
    if (const std::int64_t ns = load[static_cast<std::size_t>(tick)]; ns > 0) {
      unit.work.push_back({tick, ns});
      unit.weight += ns;
      unit.largest = std::max(unit.largest, ns);
    }
  }
}

}  // namespace indurop::scheduler
