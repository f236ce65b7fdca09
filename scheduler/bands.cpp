// SPDX-License-Identifier: Apache-2.0
#include "scheduler/bands.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace indurop::scheduler {
namespace {

bool joins(const BandPlan& band, const Task& last, const Task& task) noexcept {
  return band.kind != BandKind::Process && task.type == ModuleType::Thread && band.core == task.core &&
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
      return b.core != band.core && tasks[b.tasks.back()].priority < priority;
    });
    if (band.kind == BandKind::Thread && first_on_core && !waits_for_other && band.period_ns == basic_period_ns &&
        band.offset_ns == 0) {
      band.kind = BandKind::Inline;
    }
  }
}

}  // namespace

std::vector<BandPlan> make_bands(std::span<const Task> periodic, std::int64_t basic_period_ns) {
  std::vector<std::uint32_t> order(periodic.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return periodic[a].priority < periodic[b].priority; });
  std::vector<BandPlan> bands;
  for (const std::uint32_t i : order) {
    const Task& task = periodic[i];
    if (!bands.empty() && joins(bands.back(), periodic[bands.back().tasks.back()], task)) {
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
