// SPDX-License-Identifier: Apache-2.0
#include "scheduler/placement.h"

#include <algorithm>

#include "scheduler/placement_parts.h"

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kMaxLevelSteps = 20'000'000;

Demand demand_of(const PlacementProblem& problem, std::uint32_t module, Nanos offset) {
  const Placeable& placed = problem.modules[module];
  // Neighbours share a thread, so this overestimates the cost where many have the same period.
  const bool own_thread = placed.period != problem.basic_period || offset != Nanos::zero();
  return {placed.period, offset, placed.execution, own_thread};
}

bool in_time(const PlacementProblem& problem, std::uint32_t module, Nanos worst) {
  return worst != WorstResponses::kNotDone && worst <= problem.modules[module].deadline;
}

std::vector<Demand> demands_of(const PlacementProblem& problem, const Modules& order,
                               const std::vector<Nanos>& offsets) {
  std::vector<Demand> demands;
  demands.reserve(order.size());
  for (const std::uint32_t module : order) {
    demands.push_back(demand_of(problem, module, offsets[module]));
  }
  return demands;
}

bool holds(const PlacementProblem& problem, const Modules& order, const std::vector<Nanos>& offsets) {
  const WorstResponses found = worst_responses(demands_of(problem, order, offsets), problem.basic_period, problem.cost);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (!in_time(problem, order[i], found.worst[i])) {
      return false;
    }
  }
  return true;
}

// Returns whether `module` may come last in `rest`: none of the others has to come after it.
bool may_be_last(const PlacementProblem& problem, const Modules& rest, std::uint32_t module) {
  return std::none_of(rest.begin(), rest.end(), [&](std::uint32_t other) {
    const auto& earlier = problem.modules[other].shares;
    return std::find(earlier.begin(), earlier.end(), module) != earlier.end();
  });
}

}  // namespace

void judge(const PlacementProblem& problem, Placement& placement) {
  std::vector<Demand> demands = demands_of(problem, placement.order, placement.offset);
  std::vector<std::uint32_t> place(placement.order.size());
  for (std::uint32_t i = 0; i < placement.order.size(); ++i) {
    place[placement.order[i]] = i;
  }
  for (std::size_t i = 0; i < demands.size(); ++i) {
    const std::uint32_t module = placement.order[i];
    demands[i].core = placement.core[module];
    for (const std::uint32_t earlier : problem.modules[module].shares) {
      if (placement.core[earlier] != placement.core[module]) {
        demands[i].after.push_back(place[earlier]);
        demands[i].waiting = problem.cost.wake;
      }
    }
  }
  const WorstResponses found = worst_responses(demands, problem.basic_period, problem.cost);
  placement.busiest = found.busiest;
  placement.holds = true;
  for (std::size_t i = 0; i < demands.size(); ++i) {
    placement.holds = placement.holds && in_time(problem, placement.order[i], found.worst[i]);
  }
}

std::optional<Modules> order_that_holds(const PlacementProblem& problem, const Modules& modules,
                                        const std::vector<Nanos>& offsets) {
  if (holds(problem, modules, offsets)) {
    return modules;
  }
  Nanos longest{};
  for (const std::uint32_t module : modules) {
    longest = std::max(longest, problem.modules[module].period);
  }
  const auto count = static_cast<std::int64_t>(modules.size());
  if (count * count * count * (longest / problem.basic_period) > kMaxLevelSteps) {
    return std::nullopt;
  }
  Modules rest = modules;
  Modules backwards;
  while (!rest.empty()) {
    // Chooses the last one possible, so that the given order changes as little as possible.
    const auto last = std::find_if(rest.rbegin(), rest.rend(), [&](std::uint32_t module) {
      if (!may_be_last(problem, rest, module)) {
        return false;
      }
      Modules tried = rest;
      std::erase(tried, module);
      tried.push_back(module);
      const auto found = worst_responses(demands_of(problem, tried, offsets), problem.basic_period, problem.cost);
      return in_time(problem, module, found.worst.back());
    });
    if (last == rest.rend()) {
      return std::nullopt;
    }
    backwards.push_back(*last);
    rest.erase(std::next(last).base());
  }
  std::reverse(backwards.begin(), backwards.end());
  return backwards;
}

Placement place(const PlacementProblem& problem) {
  Placement best = place_together(problem, false);
  if (!best.holds) {
    if (Placement moved = place_together(problem, true); moved.holds) {
      best = std::move(moved);
    }
  }
  if (problem.split_sharing && problem.cores > 1) {
    Placement split = place_split(problem);
    if (split.holds != best.holds ? split.holds : split.busiest < best.busiest) {
      best = std::move(split);
    }
  }
  return best;
}

}  // namespace indurop::scheduler
