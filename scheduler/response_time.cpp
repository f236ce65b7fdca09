// SPDX-License-Identifier: Apache-2.0
#include "scheduler/response_time.h"

#include <algorithm>
#include <numeric>

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kMostSteps = 20'000'000;  // a module in a tick; a tenth of a second

class Walk {
 public:
  Walk(std::span<const Demand> demands, Nanos basic, const DispatchCost& cost, bool with_offsets)
      : demands_(demands), basic_(basic), cost_(cost), with_offsets_(with_offsets), jobs_(demands.size()) {
    worst_.resize(demands.size());
  }

  // Until ticks repeat themselves: at once without offsets, else after the longest offset and two macro periods (Leung
  // and Merrill, 1980). 0: beyond kMostSteps.
  [[nodiscard]] std::int64_t ticks() const {
    std::int64_t macro = 1;
    std::int64_t longest = 1;
    const std::int64_t most = kMostSteps / static_cast<std::int64_t>(std::max<std::size_t>(demands_.size(), 1));
    for (const Demand& demand : demands_) {
      const std::int64_t period = demand.period / basic_;
      longest = std::max(longest, period);
      macro = macro > most ? macro : std::lcm(macro, period);
    }
    const std::int64_t needed = with_offsets_ ? longest + 2 * macro : longest;
    return macro > most && with_offsets_ ? 0 : needed > most ? 0 : needed;
  }

  std::vector<Nanos> run(std::int64_t ticks) {
    for (std::int64_t tick = 0; tick < ticks; ++tick) {
      release(tick);
      execute(tick);
    }
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      // The first of all releases is the worst one; of later ones some are still under way.
      if (jobs_[i].left > Nanos::zero() && jobs_[i].released == Nanos::zero() && !with_offsets_) {
        worst_[i] = WorstResponses::kNotDone;
      }
    }
    return std::move(worst_);
  }

 private:
  struct Job {
    Nanos left{};
    Nanos released{};
  };

  void release(std::int64_t tick) {
    const Nanos now = tick * basic_;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      const Nanos first = with_offsets_ ? demands_[i].offset : Nanos::zero();
      if (now < first || (now - first) % demands_[i].period != Nanos::zero()) {
        continue;
      }
      if (jobs_[i].left > Nanos::zero()) {
        worst_[i] = WorstResponses::kNotDone;
        continue;
      }
      jobs_[i] = {demands_[i].execution + (demands_[i].own_thread ? cost_.wake : Nanos::zero()), now};
    }
  }

  void execute(std::int64_t tick) {
    Nanos used = std::min(cost_.tick, basic_);
    for (std::size_t i = 0; i < jobs_.size() && used < basic_; ++i) {
      Job& job = jobs_[i];
      if (job.left == Nanos::zero()) {
        continue;
      }
      const Nanos share = std::min(job.left, basic_ - used);
      used += share;
      job.left -= share;
      if (job.left == Nanos::zero() && worst_[i] != WorstResponses::kNotDone) {
        worst_[i] = std::max(worst_[i], tick * basic_ + used - job.released);
      }
    }
  }

  std::span<const Demand> demands_;
  Nanos basic_;
  DispatchCost cost_;
  bool with_offsets_;
  std::vector<Job> jobs_;
  std::vector<Nanos> worst_;
};

}  // namespace

WorstResponses worst_responses(std::span<const Demand> demands, Nanos basic_period, const DispatchCost& cost) {
  const bool offsets =
      std::any_of(demands.begin(), demands.end(), [](const Demand& demand) { return demand.offset != Nanos::zero(); });
  WorstResponses found;
  Walk exact(demands, basic_period, cost, offsets);
  if (const std::int64_t ticks = exact.ticks(); ticks > 0) {
    found.worst = exact.run(ticks);
    return found;
  }
  found.with_offsets = false;
  Walk together(demands, basic_period, cost, false);
  found.worst = together.run(std::max<std::int64_t>(together.ticks(), 1));
  return found;
}

}  // namespace indurop::scheduler
