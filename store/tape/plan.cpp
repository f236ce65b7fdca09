// SPDX-License-Identifier: Apache-2.0
#include "store/tape/plan.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "store/tape/layout.h"

namespace indurop::tape {
namespace {

constexpr std::uint64_t kLeastWords = 1024;
constexpr std::uint64_t kLeastRuns = 8;  // minimum runs of the longest kind on a track, so that readers can follow
constexpr std::uint64_t kLargestShare = 8;
constexpr std::uint64_t kReadingsWords = 4;  // two clock readings

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

// Words of a run in which everything changed, before and during the run; one value is recorded again.
std::uint64_t longest_run(const TrackPlan& track, std::span<const vars::DirectoryEntry> directory) {
  std::uint64_t words = 1 + kRunWords + kReadingsWords;
  std::uint64_t largest = 0;
  const auto add = [&](const std::vector<std::uint32_t>& indices, std::uint64_t times) {
    for (const std::uint32_t i : indices) {
      words += times * (1 + words_of(directory[i].value_size));
      largest = std::max(largest, 1 + words_of(directory[i].value_size));
    }
  };
  add(track.only_read, 2);
  add(track.both, 2);
  add(track.only_written, 1);
  return words + largest;
}

// Words of a ring that holds `runs` runs for a reader, who begins after the part being overwritten, at a mark.
std::uint64_t words_for(double runs, std::uint64_t run) {
  return static_cast<std::uint64_t>(std::ceil((runs + 2) * static_cast<double>(run) * kMarks / (kMarks - 2)));
}

struct Need {
  std::uint64_t least = 0;  // words; powers of two
  double wanted = 0;        // words
};

// Halves rings until they fit into `bytes`, as far as each keeps its minimum: always the one with the longest history.
void shrink(std::vector<TrackPlan>& tracks, const std::vector<Need>& needs, std::uint64_t bytes) {
  std::uint64_t sum = 0;
  for (const TrackPlan& track : tracks) {
    sum += track.words * sizeof(std::uint64_t);
  }
  while (sum > bytes) {
    std::size_t longest = tracks.size();
    double most = 0;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      const double share = static_cast<double>(tracks[i].words) / needs[i].wanted;
      if (tracks[i].words > needs[i].least && share > most) {
        longest = i;
        most = share;
      }
    }
    if (longest == tracks.size()) {
      return;
    }
    tracks[longest].words /= 2;
    sum -= tracks[longest].words * sizeof(std::uint64_t);
  }
}

std::vector<std::uint32_t> known_to_no_module(std::span<const ModuleAccess> modules, std::size_t variables) {
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
  if (auto others = known_to_no_module(modules, directory.size()); !others.empty()) {
    all.push_back({kOthers, basic_period_ns, std::move(others), {}});
  }
  std::vector<Need> needs;
  for (const ModuleAccess& access : all) {
    TrackPlan& track = plan.tracks.emplace_back(sort_out(access, plan.taped));
    const std::uint64_t run = longest_run(track, directory);
    const double runs =
        static_cast<double>(reach_ns) / static_cast<double>(std::max<std::int64_t>(access.period_ns, 1));
    const std::uint64_t wanted = std::max(words_for(runs, run), kLeastWords);
    needs.push_back({std::bit_ceil(std::max(kLeastWords, kLeastRuns * run)), static_cast<double>(wanted)});
    track.words = std::max(needs.back().least, std::bit_ceil(wanted));
    plan.bytes_wanted += track.words * sizeof(std::uint64_t);
  }
  shrink(plan.tracks, needs, bytes);
  double share = 1;
  for (std::size_t i = 0; i < plan.tracks.size(); ++i) {
    share = std::min(share, static_cast<double>(plan.tracks[i].words) / needs[i].wanted);
  }
  plan.reach_ns = static_cast<std::int64_t>(share * static_cast<double>(reach_ns));
  return plan;
}

}  // namespace indurop::tape
