// SPDX-License-Identifier: Apache-2.0
#include "scheduler/bands.h"

#include <algorithm>
#include <map>

#include "scheduler/execution_order.h"

namespace indurop::scheduler {
namespace {

// `before`: the bands so far, the last of them is the one to join. A module of equal priority on another core may run
// at the same time as the front of that band but has to be done before one of a lower priority.
bool joins(std::span<const BandPlan> before, std::span<const Task> tasks, const Task& task) noexcept {
  const BandPlan& band = before.back();
  const Task& last = tasks[band.tasks.back()];
  const int front = tasks[band.tasks.front()].priority;
  const bool passes_other =
      task.priority != front && std::any_of(before.begin(), before.end(), [&](const BandPlan& other) {
        return other.core != band.core && tasks[other.tasks.back()].priority == front;
      });
  return !passes_other && band.kind != BandKind::Process && task.type == ModuleType::Thread && band.core == task.core &&
         band.period_ns == task.period_ns && band.offset_ns == task.offset_ns && band.overrun == task.overrun &&
         last.type == ModuleType::Thread;
}

void decide_inline(std::vector<BandPlan>& bands, std::span<const Task> tasks, std::int64_t basic_period_ns) {
  for (std::size_t i = 0; i < bands.size(); ++i) {
    BandPlan& band = bands[i];
    const auto before = std::span(bands).first(i);
    const bool first_on_core =
        std::none_of(before.begin(), before.end(), [&](const BandPlan& b) { return b.core == band.core; });
    const int priority = tasks[band.tasks.front()].priority;
    const bool waits_for_other = std::any_of(before.begin(), before.end(), [&](const BandPlan& b) {
      return b.core != band.core && tasks[b.tasks.front()].priority < priority;
    });
    if (band.kind == BandKind::Thread && first_on_core && !waits_for_other && band.period_ns == basic_period_ns &&
        band.offset_ns == 0) {
      band.kind = BandKind::Inline;
    }
  }
}

}  // namespace

std::vector<BandPlan> make_bands(std::span<const Task> periodic, std::int64_t basic_period_ns) {
  std::vector<BandPlan> bands;
  for (const std::uint32_t i :
       execution_order(periodic.size(), [&](std::uint32_t task) { return periodic[task].priority; })) {
    const Task& task = periodic[i];
    if (!bands.empty() && joins(bands, periodic, task)) {
      bands.back().tasks.push_back(i);
      continue;
    }
    BandPlan band;
    band.kind = task.type == ModuleType::Process ? BandKind::Process : BandKind::Thread;
    band.core = task.core;
    band.period_ns = task.period_ns;
    band.offset_ns = task.offset_ns;
    band.overrun = task.overrun;
    band.tasks.push_back(i);
    bands.push_back(std::move(band));
  }
  decide_inline(bands, periodic, basic_period_ns);
  std::map<int, int> next_level;
  for (BandPlan& band : bands) {
    if (band.kind == BandKind::Inline) {
      band.fifo_priority = kTickPriority;
      continue;
    }
    const auto level = next_level.try_emplace(band.core, kTopBandPriority).first;
    band.fifo_priority = std::max(level->second, kLowestBandPriority);
    --level->second;
  }
  return bands;
}

}  // namespace indurop::scheduler
