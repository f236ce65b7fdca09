// SPDX-License-Identifier: Apache-2.0
// Places modules one by one on cores, where those that share data wait for one another: first the module on which most
// work depends, each on the core where it can begin first. A few modules are searched completely, many are improved by
// moving one at a time. Only the tick in which all are released is considered.

#include <algorithm>
#include <numeric>

#include "scheduler/placement_parts.h"

namespace indurop::scheduler {
namespace {

constexpr std::size_t kFewModules = 9;               // up to this number: complete search
constexpr std::int64_t kMaxSplitNodes = 400'000;     // of that search
constexpr std::int64_t kMaxSplitSteps = 30'000'000;  // of improving, one step is a module in a tick
constexpr Nanos kNeverFits = Nanos::max();

class SplitSearch {
 public:
  explicit SplitSearch(const PlacementProblem& problem)
      : problem_(problem),
        count_(problem.modules.size()),
        next_(count_),
        tail_(count_),
        core_(count_, -1),
        ends_(count_),
        free_(static_cast<std::size_t>(problem.cores)) {
    for (std::size_t i = count_; i-- > 0;) {
      for (const std::uint32_t earlier : problem.modules[i].shares) {
        next_[earlier].push_back(static_cast<std::uint32_t>(i));
      }
      Nanos longest{};
      for (const std::uint32_t later : next_[i]) {
        longest = std::max(longest, tail_[later]);
      }
      tail_[i] = problem.modules[i].execution + longest;
    }
  }

  Placement run() {
    Placement best = in_list_order(true);
    keep_better(best, in_list_order(false));
    if (count_ <= kFewModules) {
      least_ = best.busiest;
      clear();
      try_limit(Nanos::zero());
      if (!found_order_.empty()) {
        keep_better(best, placement_of(found_order_, found_core_));
      }
    } else {
      improve(best);
    }
    // Keeps the given order if another one gains nothing.
    Modules given(count_);
    std::iota(given.begin(), given.end(), 0U);
    Placement as_given = placement_of(given, best.core);
    return better(best, as_given) ? best : as_given;
  }

 private:
  [[nodiscard]] static bool better(const Placement& a, const Placement& b) {
    return a.holds != b.holds ? a.holds : a.busiest < b.busiest;
  }
  static void keep_better(Placement& best, Placement other) {
    if (better(other, best)) {
      best = std::move(other);
    }
  }

  void clear() {
    std::fill(core_.begin(), core_.end(), -1);
    std::fill(free_.begin(), free_.end(), std::min(problem_.cost.tick, problem_.basic_period));
    order_.clear();
  }

  [[nodiscard]] bool ready(std::size_t module) const {
    const auto& earlier = problem_.modules[module].shares;
    return core_[module] < 0 &&
           std::all_of(earlier.begin(), earlier.end(), [&](std::uint32_t other) { return core_[other] >= 0; });
  }

  // Returns when the module would end on this core.
  [[nodiscard]] Nanos end_on(std::size_t module, int core) const {
    const Placeable& placed = problem_.modules[module];
    Nanos begin = free_[static_cast<std::size_t>(core)];
    Nanos waiting{};
    for (const std::uint32_t earlier : placed.shares) {
      if (core_[earlier] != core) {
        begin = std::max(begin, ends_[earlier]);
        waiting = problem_.cost.wake;
      }
    }
    const Nanos woken = placed.period > problem_.basic_period ? problem_.cost.wake : Nanos::zero();
    return begin + waiting + woken + placed.execution;
  }
  [[nodiscard]] bool allowed(std::size_t module, int core) const {
    return problem_.modules[module].core < 0 || problem_.modules[module].core == core;
  }

  // `by_tail`: of the modules that may begin, takes the one on which most work depends; else the given order.
  Placement in_list_order(bool by_tail) {
    clear();
    while (order_.size() < count_) {
      std::size_t chosen = count_;
      for (std::size_t i = 0; i < count_; ++i) {
        if (ready(i) && (chosen == count_ || (by_tail && tail_[i] > tail_[chosen]))) {
          chosen = i;
        }
      }
      int best = -1;
      for (int core = 0; core < problem_.cores; ++core) {
        if (allowed(chosen, core) && (best < 0 || end_on(chosen, core) < end_on(chosen, best))) {
          best = core;
        }
      }
      put(chosen, best);
    }
    return placement_of(order_, core_);
  }

  void put(std::size_t module, int core) {
    ends_[module] = end_on(module, core);
    free_[static_cast<std::size_t>(core)] = ends_[module];
    core_[module] = core;
    order_.push_back(static_cast<std::uint32_t>(module));
  }

  // Tries every continuation that could be better.
  void try_limit(Nanos busiest) {
    if (order_.size() == count_) {
      found_order_ = order_;
      found_core_ = core_;
      least_ = busiest;
      return;
    }
    for (std::size_t i = 0; i < count_; ++i) {
      bool empty_seen = false;
      for (int core = 0; core < problem_.cores && ready(i) && ++nodes_ < kMaxSplitNodes; ++core) {
        const bool empty = std::find(core_.begin(), core_.end(), core) == core_.end();
        if (!allowed(i, core) || (empty && empty_seen && problem_.modules[i].core < 0)) {
          continue;
        }
        empty_seen = empty_seen || empty;
        const Nanos end = end_on(i, core);
        if (end + tail_[i] - problem_.modules[i].execution >= least_ || end > problem_.modules[i].deadline) {
          continue;
        }
        const Nanos ended = ends_[i];
        const Nanos free = free_[static_cast<std::size_t>(core)];
        put(i, core);
        try_limit(std::max(busiest, end));
        order_.pop_back();
        core_[i] = -1;
        ends_[i] = ended;
        free_[static_cast<std::size_t>(core)] = free;
      }
    }
  }

  [[nodiscard]] Placement placement_of(const Modules& order, const std::vector<int>& core) const {
    Placement placement;
    placement.core = core;
    placement.order = order;
    for (const Placeable& module : problem_.modules) {
      placement.offset.push_back(module.offset);
    }
    judge(problem_, placement);
    return placement;
  }

  void improve(Placement& best) const {
    Nanos longest{};
    for (const Placeable& module : problem_.modules) {
      longest = std::max(longest, module.period);
    }
    const std::int64_t steps = static_cast<std::int64_t>(count_) * 3 * (longest / problem_.basic_period);
    std::int64_t left = kMaxSplitSteps / std::max<std::int64_t>(steps, 1);
    for (bool helped = true; helped && left > 0;) {
      helped = false;
      for (std::size_t i = 0; i < count_; ++i) {
        for (int core = 0; core < problem_.cores && problem_.modules[i].core < 0 && left > 0; ++core) {
          Placement other = best;
          other.core[i] = core;
          judge(problem_, other);
          --left;
          if (better(other, best)) {
            best = std::move(other);
            helped = true;
          }
        }
      }
    }
  }

  const PlacementProblem& problem_;
  std::size_t count_;
  std::vector<Modules> next_;
  std::vector<Nanos> tail_;  // execution time from the begin of a module to the end of all that depends on it
  std::vector<int> core_;    // -1: not placed
  std::vector<Nanos> ends_;
  std::vector<Nanos> free_;  // by core
  Modules order_;
  Nanos least_ = kNeverFits;
  std::int64_t nodes_ = 0;
  Modules found_order_;
  std::vector<int> found_core_;
};

}  // namespace

Placement place_split(const PlacementProblem& problem) {
  return SplitSearch(problem).run();
}

}  // namespace indurop::scheduler
