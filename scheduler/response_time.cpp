// SPDX-License-Identifier: Apache-2.0
#include "scheduler/response_time.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kMaxSteps = 20'000'000;  // one step is a module in a tick; takes a tenth of a second

class Walk {
 public:
  Walk(std::span<const Demand> demands, Nanos basic, const DispatchCost& cost, bool with_offsets, bool across)
      : demands_(demands),
        basic_(basic),
        cost_(cost),
        with_offsets_(with_offsets),
        across_(across),
        jobs_(demands.size()) {
    found_.worst.resize(demands.size());
    std::map<int, std::size_t> known;
    for (const Demand& demand : demands) {
      cores_.push_back(known.try_emplace(demand.core, known.size()).first->second);
    }
    used_.resize(known.size());
  }

  // Number of ticks with the longest response of all: on one core the first release without offsets (Liu and Layland,
  // 1973). Who waits for another core can be worse off at a later one, when it is released together with others. With
  // offsets they repeat after the longest one and two macro periods (Leung and Merrill, 1980). 0: beyond kMaxSteps.
  [[nodiscard]] std::int64_t ticks() const {
    std::int64_t macro = 1;
    std::int64_t longest = 1;
    const std::int64_t most = kMaxSteps / static_cast<std::int64_t>(std::max<std::size_t>(demands_.size(), 1));
    for (const Demand& demand : demands_) {
      const std::int64_t period = demand.period / basic_;
      longest = std::max(longest, period);
      macro = macro > most ? macro : std::lcm(macro, period);
    }
    const std::int64_t needed = with_offsets_ ? longest + 2 * macro : across_ ? macro : longest;
    return macro > most && (with_offsets_ || across_) ? 0 : needed > most ? 0 : needed;
  }

  WorstResponses run(std::int64_t ticks) {
    for (std::int64_t tick = 0; tick < ticks; ++tick) {
      release(tick);
      execute(tick);
    }
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      // All are released again now. On one core the first of all releases is the worst one; some later ones are not
      // finished.
      if (jobs_[i].left > Nanos::zero() && (jobs_[i].released == Nanos::zero() || across_) && !with_offsets_) {
        found_.worst[i] = WorstResponses::kNotDone;
      }
    }
    return std::move(found_);
  }

 private:
  struct Job {
    Nanos left{};
    Nanos released{};
    Nanos ended{};  // end in this tick; the tick's end if it is not finished then
  };

  void release(std::int64_t tick) {
    const Nanos now = tick * basic_;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      const Nanos first = with_offsets_ ? demands_[i].offset : Nanos::zero();
      if (now < first || (now - first) % demands_[i].period != Nanos::zero()) {
        continue;
      }
      if (jobs_[i].left > Nanos::zero()) {
        found_.worst[i] = WorstResponses::kNotDone;
        continue;
      }
      const Nanos woken = demands_[i].own_thread ? cost_.wake : Nanos::zero();
      jobs_[i] = {demands_[i].execution + woken + demands_[i].waiting, now, {}};
    }
  }

  void execute(std::int64_t tick) {
    std::fill(used_.begin(), used_.end(), std::min(cost_.tick, basic_));
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      Job& job = jobs_[i];
      if (job.left == Nanos::zero()) {
        job.ended = Nanos::zero();
        continue;
      }
      Nanos& used = used_[cores_[i]];
      for (const std::uint32_t earlier : demands_[i].after) {
        used = std::max(used, jobs_[earlier].ended);
      }
      const Nanos share = std::min(job.left, basic_ - used);
      used += share;
      job.left -= share;
      job.ended = job.left == Nanos::zero() ? used : basic_;
      if (job.left == Nanos::zero() && found_.worst[i] != WorstResponses::kNotDone) {
        found_.worst[i] = std::max(found_.worst[i], tick * basic_ + used - job.released);
      }
    }
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      used_[cores_[i]] += jobs_[i].left;
    }
    for (const Nanos used : used_) {
      found_.busiest = std::max(found_.busiest, used);
    }
  }

  std::span<const Demand> demands_;
  Nanos basic_;
  DispatchCost cost_;
  bool with_offsets_;
  bool across_;  // some wait for another core
  std::vector<Job> jobs_;
  std::vector<std::size_t> cores_;  // by demand, into used_
  std::vector<Nanos> used_;
  WorstResponses found_;
};

}  // namespace

WorstResponses worst_responses(std::span<const Demand> demands, Nanos basic_period, const DispatchCost& cost) {
  const bool offsets =
      std::any_of(demands.begin(), demands.end(), [](const Demand& demand) { return demand.offset != Nanos::zero(); });
  const bool across =
      std::any_of(demands.begin(), demands.end(), [](const Demand& demand) { return !demand.after.empty(); });
  Walk exact(demands, basic_period, cost, offsets, across);
  if (const std::int64_t ticks = exact.ticks(); ticks > 0) {
    return exact.run(ticks);
  }
  std::vector<Demand> simpler(demands.begin(), demands.end());
  for (Demand& demand : simpler) {
    demand.core = across ? 0 : demand.core;
    demand.after.clear();
  }
  Walk together(simpler, basic_period, cost, false, false);
  WorstResponses found = together.run(std::max<std::int64_t>(together.ticks(), 1));
  found.with_offsets = false;
  return found;
}

}  // namespace indurop::scheduler
