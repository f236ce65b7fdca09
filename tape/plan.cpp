// SPDX-License-Identifier: Apache-2.0
#include "tape/plan.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "tape/layout.h"

namespace indurop::tape {
namespace {

constexpr std::uint64_t kLeastWords = 1024;
constexpr std::uint64_t kLeastRuns = 8;  // of the longest kind that a track holds, so that readers can follow
constexpr std::uint64_t kLargestShare = 8;

void sort_once(std::vector<std::uint32_t>& indices) {
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

TrackPlan sort_out(const ModuleAccess& access, const std::vector<bool>& taped) {
  TrackPlan track;
  track.module = access.module;
  std::vector<std::uint32_t> reads = access.reads;
  std::vector<std::uint32_t> writes = access.writes;
  for (auto* indices : {&reads, &writes}) {
    sort_once(*indices);
    std::erase_if(*indices, [&](std::uint32_t i) { return !taped[i]; });
  }
  std::set_intersection(reads.begin(), reads.end(), writes.begin(), writes.end(), std::back_inserter(track.both));
  std::set_difference(reads.begin(), reads.end(), writes.begin(), writes.end(), std::back_inserter(track.only_read));
  std::set_difference(writes.begin(), writes.end(), reads.begin(), reads.end(), std::back_inserter(track.only_written));
  return track;
}

// Of a run in which everything changed, before and while it ran.
std::uint64_t longest_run(const TrackPlan& track, std::span<const vars::DirectoryEntry> directory) {
  std::uint64_t words = 1 + kRunWords;
  const auto add = [&](const std::vector<std::uint32_t>& indices, std::uint64_t times) {
    for (const std::uint32_t i : indices) {
      words += times * (1 + words_of(directory[i].value_size));
    }
  };
  add(track.only_read, 2);
  add(track.both, 2);
  add(track.only_written, 1);
  return words;
}

std::vector<std::uint32_t> known_to_nobody(std::span<const ModuleAccess> modules, std::size_t variables) {
  std::vector<bool> known(variables, false);
  for (const ModuleAccess& access : modules) {
    for (const auto* indices : {&access.reads, &access.writes}) {
      for (const std::uint32_t i : *indices) {
        known[i] = true;
      }
    }
  }
  std::vector<std::uint32_t> others;
  for (std::uint32_t i = 0; i < variables; ++i) {
    if (!known[i]) {
      others.push_back(i);
    }
  }
  return others;
}

}  // namespace

TapePlan plan_tape(std::span<const ModuleAccess> modules, std::span<const vars::DirectoryEntry> directory,
                   std::int64_t basic_period_ns, std::int64_t reach_ns, std::uint64_t bytes) {
  TapePlan plan;
  plan.taped.resize(directory.size());
  for (std::size_t i = 0; i < directory.size(); ++i) {
    plan.taped[i] = directory[i].value_size <= bytes / kLargestShare;
  }
  std::vector<ModuleAccess> all(modules.begin(), modules.end());
  if (auto others = known_to_nobody(modules, directory.size()); !others.empty()) {
    all.push_back({kOthers, basic_period_ns, std::move(others), {}});
  }
  std::vector<double> wanted;
  double sum = 0;
  for (const ModuleAccess& access : all) {
    plan.tracks.push_back(sort_out(access, plan.taped));
    const auto runs = static_cast<double>(reach_ns) / static_cast<double>(std::max<std::int64_t>(access.period_ns, 1));
    wanted.push_back(runs * static_cast<double>(longest_run(plan.tracks.back(), directory)));
    sum += wanted.back();
  }
  const double share = std::min(1.0, static_cast<double>(bytes) / (sizeof(std::uint64_t) * std::max(sum, 1.0)));
  for (std::size_t i = 0; i < plan.tracks.size(); ++i) {
    const std::uint64_t least = std::max(kLeastWords, kLeastRuns * longest_run(plan.tracks[i], directory));
    // Downwards, so that together they keep to `bytes`, but for what each needs at least.
    const auto fits = std::bit_floor(static_cast<std::uint64_t>(wanted[i] * share) + 1);
    plan.tracks[i].words = std::max(std::bit_ceil(least), fits);
  }
  return plan;
}

}  // namespace indurop::tape
