// SPDX-License-Identifier: Apache-2.0
#include "scheduler/bands.h"

#include <algorithm>
#include <map>

#include "scheduler/execution_order.h"

namespace indurop::scheduler {
namespace {

// The waiting between cores that data flow requires, by task.
struct Crossing {
  std::vector<bool> waits;    // for a task of another core
  std::vector<bool> awaited;  // by a task of another core
};

Crossing crossing_of(std::span<const Task> tasks) {
  Crossing crossing{std::vector<bool>(tasks.size()), std::vector<bool>(tasks.size())};
  std::map<std::uint32_t, std::size_t> by_index;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    by_index.emplace(tasks[i].index, i);
  }
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    for (const std::uint32_t index : tasks[i].after) {
      const auto other = by_index.find(index);
      if (other != by_index.end() && tasks[other->second].core != tasks[i].core) {
        crossing.waits[i] = true;
        crossing.awaited[other->second] = true;
      }
    }
  }
  return crossing;
}

bool alike(const BandPlan& band, std::span<const Task> tasks, const Task& task) noexcept {
  return band.kind != BandKind::Process && task.type == ModuleType::Thread && band.core == task.core &&
         band.period_ns == task.period_ns && band.offset_ns == task.offset_ns && band.overrun == task.overrun &&
         tasks[band.tasks.back()].type == ModuleType::Thread;
}

// `before`: the bands so far; the last one is the candidate to join. A module of equal priority on another core may run
// at the same time as the front of that band but has to be done before one of a lower priority.
bool joins(std::span<const BandPlan> before, std::span<const Task> tasks, const Task& task) noexcept {
  const BandPlan& band = before.back();
  const int front = tasks[band.tasks.front()].priority;
  const bool passes_other =
      task.priority != front && std::any_of(before.begin(), before.end(), [&](const BandPlan& other) {
        return other.core != band.core && tasks[other.tasks.back()].priority == front;
      });
  return !passes_other && alike(band, tasks, task);
}

// Returns the band this task joins; null: it begins a new one.
BandPlan* band_for(std::vector<BandPlan>& bands, std::span<const Task> tasks, std::uint32_t task, CoreOrder order,
                   const Crossing& crossing) {
  if (order == CoreOrder::Total) {
    return !bands.empty() && joins(bands, tasks, tasks[task]) ? &bands.back() : nullptr;
  }
  const auto last =
      std::find_if(bands.rbegin(), bands.rend(), [&](const BandPlan& band) { return band.core == tasks[task].core; });
  const bool joins = last != bands.rend() && !crossing.waits[task] && !crossing.awaited[last->tasks.back()] &&
                     alike(*last, tasks, tasks[task]);
  return joins ? &*last : nullptr;
}

void decide_inline(std::vector<BandPlan>& bands, std::span<const Task> tasks, std::int64_t basic_period_ns,
                   CoreOrder order, const Crossing& crossing) {
  for (std::size_t i = 0; i < bands.size(); ++i) {
    BandPlan& band = bands[i];
    const auto before = std::span(bands).first(i);
    const bool first_on_core =
        std::none_of(before.begin(), before.end(), [&](const BandPlan& b) { return b.core == band.core; });
    const int priority = tasks[band.tasks.front()].priority;
    const bool waits_for_other = order == CoreOrder::Data
                                     ? crossing.waits[band.tasks.front()]
                                     : std::any_of(before.begin(), before.end(), [&](const BandPlan& b) {
                                         return b.core != band.core && tasks[b.tasks.front()].priority < priority;
                                       });
    if (band.kind == BandKind::Thread && first_on_core && !waits_for_other && band.period_ns == basic_period_ns &&
        band.offset_ns == 0) {
      band.kind = BandKind::Inline;
    }
  }
}

}  // namespace

std::vector<BandPlan> make_bands(std::span<const Task> periodic, std::int64_t basic_period_ns, CoreOrder order) {
  const Crossing crossing = crossing_of(periodic);
  std::vector<BandPlan> bands;
  for (const std::uint32_t i :
       execution_order(periodic.size(), [&](std::uint32_t task) { return periodic[task].priority; })) {
    const Task& task = periodic[i];
    if (BandPlan* joined = band_for(bands, periodic, i, order, crossing); joined != nullptr) {
      joined->tasks.push_back(i);
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
  decide_inline(bands, periodic, basic_period_ns, order, crossing);
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
