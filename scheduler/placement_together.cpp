// SPDX-License-Identifier: Apache-2.0
// Places units of modules that share data on cores: the largest first on the emptiest core, then single moves and
// exchanges as long as they help, and where there are few units all placements that could be better.

#include <algorithm>
#include <limits>
#include <numeric>

#include "scheduler/core_loads.h"
#include "scheduler/load_units.h"
#include "scheduler/placement_parts.h"

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kMaxJoinSteps = 60'000'000;  // of improving, one step is a tick of a core
constexpr std::size_t kFewUnits = 14;               // up to this number: complete search
constexpr std::int64_t kMaxJoinNodes = 200'000;     // of that search
constexpr std::int64_t kNoTime = std::numeric_limits<std::int64_t>::max();

class Search {
 public:
  Search(const PlacementProblem& problem, const LoadUnits& units)
      : problem_(problem),
        units_(units.all()),
        loads_(problem.cores, units.ticks(), problem.basic_period.count(), problem.cost.tick.count()),
        spots_(units_.size()),
        least_(least_possible(units)) {}

  Placement run() {
    spread(false);
    improve();
    remember();
    if (!best_holds_) {
      spread(true);
      remember();
    }
    if (units_.size() <= kFewUnits && (!best_holds_ || best_busiest_ > least_)) {
      clear();
      nodes_ = 0;
      place_from(0);
    }
    return result();
  }

 private:
  struct Spot {
    int core = -1;
    std::int64_t shift = 0;
  };

  // Lower bound: no placement keeps all cores busy for less.
  [[nodiscard]] std::int64_t least_possible(const LoadUnits& units) const {
    std::vector<std::int64_t> load(static_cast<std::size_t>(units.ticks()));
    std::int64_t least = 0;
    bool moves = false;
    for (const LoadUnit& unit : units_) {
      least = std::max(least, unit.largest);
      moves = moves || unit.shifts > 1;
      for (const LoadUnit::Piece& piece : unit.work) {
        load[static_cast<std::size_t>(piece.tick)] += piece.ns;
      }
    }
    const std::int64_t most = *std::max_element(load.begin(), load.end());
    const std::int64_t shared = moves ? 0 : (most + problem_.cores - 1) / problem_.cores;
    return std::max(least, shared) + problem_.cost.tick.count();
  }

  void put(std::size_t unit, int core, std::int64_t shift) {
    spots_[unit] = {core, shift};
    loads_.add(core, units_[unit], shift);
  }
  void take(std::size_t unit) {
    loads_.remove(spots_[unit].core, units_[unit], spots_[unit].shift);
    spots_[unit] = {};
  }
  void clear() {
    for (std::size_t i = 0; i < units_.size(); ++i) {
      if (spots_[i].core >= 0) {
        take(i);
      }
    }
  }

  [[nodiscard]] Modules modules_on(int core) const {
    Modules modules;
    for (std::size_t i = 0; i < units_.size(); ++i) {
      if (spots_[i].core == core) {
        modules.insert(modules.end(), units_[i].modules.begin(), units_[i].modules.end());
      }
    }
    std::sort(modules.begin(), modules.end());
    return modules;
  }
  [[nodiscard]] std::vector<Nanos> offsets() const {
    std::vector<Nanos> offsets;
    for (const Placeable& module : problem_.modules) {
      offsets.push_back(module.offset);
    }
    for (std::size_t i = 0; i < units_.size(); ++i) {
      for (const std::uint32_t module : units_[i].modules) {
        offsets[module] += problem_.basic_period * spots_[i].shift;
      }
    }
    return offsets;
  }
  [[nodiscard]] bool core_holds(int core) const {
    return order_that_holds(problem_, modules_on(core), offsets()).has_value();
  }

  // `in_time`: uses only cores on which all deadlines hold, as long as there is one.
  void spread(bool in_time) {
    clear();
    std::int64_t left = kMaxJoinSteps;  // 0: no more shifts are tried
    for (std::size_t i = 0; i < units_.size(); ++i) {
      Spot best;
      std::int64_t least = kNoTime;
      bool best_holds = false;
      for (int core = 0; core < problem_.cores; ++core) {
        for (std::int64_t shift = 0; shift < (left > 0 ? units_[i].shifts : 1) && allowed(i, core); ++shift) {
          const std::int64_t busiest = loads_.busiest_with(core, &units_[i], shift);
          left -= 2 * loads_.ticks();
          if (busiest >= least && (!in_time || best_holds)) {
            continue;
          }
          bool holds = true;
          if (in_time && left > 0) {
            put(i, core, shift);
            holds = core_holds(core);
            left -= 3 * loads_.ticks() * static_cast<std::int64_t>(modules_on(core).size());
            take(i);
          }
          if (best.core < 0 || holds > best_holds || (holds == best_holds && busiest < least)) {
            best = {core, shift};
            least = busiest;
            best_holds = holds;
          }
        }
      }
      put(i, best.core, best.shift);
    }
  }
  [[nodiscard]] bool allowed(std::size_t unit, int core) const {
    return units_[unit].core < 0 || units_[unit].core == core;
  }

  // Moves a unit of the busiest core to another one, or exchanges it with one there, as long as that helps.
  void improve() {
    const std::int64_t steps_of_try = 2 * loads_.ticks();
    for (std::int64_t left = kMaxJoinSteps; left > 0 && loads_.busiest() > least_;) {
      int worst = 0;
      for (int core = 1; core < problem_.cores; ++core) {
        worst = loads_.busiest(core) > loads_.busiest(worst) ? core : worst;
      }
      Change best{0, units_.size(), -1, loads_.busiest(worst)};
      for (std::size_t unit = 0; unit < units_.size() && left > 0; ++unit) {
        if (spots_[unit].core == worst && units_[unit].core < 0) {
          left -= steps_of_try * best_change(unit, best);
        }
      }
      if (best.core < 0) {
        return;
      }
      const Spot from = spots_[best.unit];
      take(best.unit);
      std::int64_t shift = from.shift;
      if (best.other < units_.size()) {
        const std::int64_t other_shift = spots_[best.other].shift;
        take(best.other);
        put(best.other, worst, other_shift);
      }
      put(best.unit, best.core, shift);
    }
  }
  struct Change {
    std::size_t unit;
    std::size_t other;  // unit to exchange with; none: a move
    int core;           // target core; -1: nothing helps
    std::int64_t busiest;
  };
  // Returns how many changes were tried.
  std::int64_t best_change(std::size_t unit, Change& best) const {
    const int from = spots_[unit].core;
    const std::int64_t shift = spots_[unit].shift;
    std::int64_t tried = 0;
    for (int core = 0; core < problem_.cores; ++core) {
      if (core != from && loads_.busiest(core) < best.busiest) {
        ++tried;
        const std::int64_t after = std::max(loads_.busiest_with(core, &units_[unit], shift),
                                            loads_.busiest_with(from, nullptr, 0, &units_[unit], shift));
        best = after < best.busiest ? Change{unit, units_.size(), core, after} : best;
      }
    }
    for (std::size_t other = 0; other < units_.size(); ++other) {
      const Spot& spot = spots_[other];
      if (spot.core == from || units_[other].core >= 0 || units_[other].weight >= units_[unit].weight) {
        continue;
      }
      ++tried;
      const std::int64_t there = loads_.busiest_with(spot.core, &units_[unit], shift, &units_[other], spot.shift);
      if (there < best.busiest) {
        const std::int64_t here = loads_.busiest_with(from, &units_[other], spot.shift, &units_[unit], shift);
        best = std::max(here, there) < best.busiest ? Change{unit, other, spot.core, std::max(here, there)} : best;
      }
    }
    return tried;
  }

  // Stores the current placement if it is better than the best found so far.
  void remember() {
    bool holds = true;
    for (int core = 0; core < problem_.cores && holds; ++core) {
      holds = core_holds(core);
    }
    const std::int64_t busiest = loads_.busiest();
    if (best_.empty() || holds > best_holds_ || (holds == best_holds_ && busiest < best_busiest_)) {
      best_ = spots_;
      best_holds_ = holds;
      best_busiest_ = busiest;
    }
  }

  // Tries all placements of the units from this one on that could be better. Cores without units are equivalent.
  void place_from(std::size_t unit) {
    if (unit == units_.size()) {
      remember();
      return;
    }
    bool empty_seen = false;
    for (int core = 0; core < problem_.cores && nodes_ < kMaxJoinNodes; ++core) {
      const bool empty =
          std::none_of(spots_.begin(), spots_.end(), [core](const Spot& spot) { return spot.core == core; });
      if (!allowed(unit, core) || (empty && empty_seen && units_[unit].core < 0)) {
        continue;
      }
      empty_seen = empty_seen || (empty && !bound_[static_cast<std::size_t>(core)]);
      for (std::int64_t shift = 0; shift < units_[unit].shifts && nodes_ < kMaxJoinNodes; ++shift) {
        const std::int64_t busiest = loads_.busiest_with(core, &units_[unit], shift);
        if ((best_holds_ && busiest >= best_busiest_) || (best_holds_ && best_busiest_ <= least_)) {
          continue;
        }
        nodes_ += 1 + loads_.ticks() / 16;
        put(unit, core, shift);
        if (core_holds(core)) {
          place_from(unit + 1);
        }
        take(unit);
      }
    }
  }

  Placement result() {
    spots_ = best_;
    Placement placement;
    placement.core.resize(problem_.modules.size());
    for (std::size_t i = 0; i < units_.size(); ++i) {
      for (const std::uint32_t module : units_[i].modules) {
        const int bound = problem_.modules[module].core;  // where users split modules that share data
        placement.core[module] = bound >= 0 ? bound : spots_[i].core;
      }
    }
    placement.offset = offsets();
    placement.order = merged_order(placement.offset);
    judge(problem_, placement);
    return placement;
  }

  // Returns the orders of the cores merged into one, as near as possible to the given order.
  [[nodiscard]] Modules merged_order(const std::vector<Nanos>& offsets) const {
    std::vector<Modules> orders;
    for (int core = 0; core < problem_.cores; ++core) {
      const Modules modules = modules_on(core);
      orders.push_back(order_that_holds(problem_, modules, offsets).value_or(modules));
      std::reverse(orders.back().begin(), orders.back().end());
    }
    Modules merged;
    while (merged.size() < problem_.modules.size()) {
      const auto next = std::min_element(orders.begin(), orders.end(), [](const Modules& a, const Modules& b) {
        return !a.empty() && (b.empty() || a.back() < b.back());
      });
      merged.push_back(next->back());
      next->pop_back();
    }
    return keeps_sharing(merged) ? merged : given_order();
  }

  [[nodiscard]] Modules given_order() const {
    Modules order(problem_.modules.size());
    std::iota(order.begin(), order.end(), 0U);
    return order;
  }
  [[nodiscard]] bool keeps_sharing(const Modules& order) const {
    std::vector<bool> passed(order.size());
    for (const std::uint32_t module : order) {
      passed[module] = true;
      const auto& earlier = problem_.modules[module].shares;
      if (!std::all_of(earlier.begin(), earlier.end(), [&](std::uint32_t other) { return passed[other]; })) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] std::vector<bool> bound_cores() const {
    std::vector<bool> bound(static_cast<std::size_t>(problem_.cores));
    for (const LoadUnit& unit : units_) {
      if (unit.core >= 0) {
        bound[static_cast<std::size_t>(unit.core)] = true;
      }
    }
    return bound;
  }

  const PlacementProblem& problem_;
  const std::vector<LoadUnit>& units_;
  CoreLoads loads_;
  std::vector<Spot> spots_;  // by unit
  std::int64_t least_;
  std::vector<bool> bound_ = bound_cores();  // by core: a module is bound to it
  std::vector<Spot> best_;
  bool best_holds_ = false;
  std::int64_t best_busiest_ = kNoTime;
  std::int64_t nodes_ = 0;
};

}  // namespace

Placement place_together(const PlacementProblem& problem, bool move_offsets) {
  const LoadUnits units(problem, move_offsets);
  return Search(problem, units).run();
}

}  // namespace indurop::scheduler
