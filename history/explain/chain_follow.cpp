// SPDX-License-Identifier: Apache-2.0
#include "history/explain/chain_follow.h"

#include <algorithm>
#include <map>

#include "history/explain/timeline.h"

namespace indurop::explain {
namespace {

// Results of the search for the run whose value another run began with.
constexpr std::ptrdiff_t kNothing = -1;   // of a run that was not read
constexpr std::ptrdiff_t kForeign = -2;   // from another writer
constexpr std::ptrdiff_t kRepeated = -3;  // one of several runs
// Maximum number of runs to search back for a value.
constexpr std::ptrdiff_t kBack = 1000;
// A value from the network is at most this many runs old: with fewer runs before it, it may be of a run that was not
// read.
constexpr std::ptrdiff_t kSettled = 20;

// Returns the last run that had ended at a time; kNothing: none.
std::ptrdiff_t ended_before(const std::vector<ChainRun>& runs, std::int64_t time_ns) {
  const auto behind =
      std::partition_point(runs.begin(), runs.end(), [&](const ChainRun& run) { return run.end_ns <= time_ns; });
  return behind - runs.begin() - 1;
}

const ChainRun& at(const std::vector<ChainRun>& runs, std::ptrdiff_t index) {
  return runs[static_cast<std::size_t>(index)];
}

bool is_followed(const std::vector<ChainRun>& runs, std::ptrdiff_t index) {
  const bool last = index + 1 == static_cast<std::ptrdiff_t>(runs.size());
  return !last && at(runs, index + 1).number == at(runs, index).number + 1;
}

// On one board a run sees the value of the last run that had ended, or of one that had begun.
std::ptrdiff_t seen_here(const std::vector<ChainRun>& writers, const ChainRun& reader) {
  const std::ptrdiff_t last = ended_before(writers, reader.start_ns);
  const auto size = static_cast<std::ptrdiff_t>(writers.size());
  if (reader.seen == 0 || (last != kNothing && at(writers, last).left == 0)) {
    return kNothing;
  }
  if (last != kNothing && at(writers, last).left == reader.seen) {
    return last;
  }
  const bool next = last + 1 < size && (last == kNothing || is_followed(writers, last)) &&
                    at(writers, last + 1).start_ns < reader.end_ns && at(writers, last + 1).left == reader.seen;
  return next ? last + 1 : last == kNothing ? kNothing : kForeign;
}

// Through the network only the value itself identifies its run: the only run that wrote it since the one seen before.
class Travelled {
 public:
  // `origins`: the runs that the writers' runs saw; empty: the writers are the first stage.
  Travelled(const std::vector<ChainRun>& writers, const std::vector<std::ptrdiff_t>& origins)
      : writers_(writers), origins_(origins) {}

  std::ptrdiff_t seen(const ChainRun& reader) {
    const std::ptrdiff_t newest = ended_before(writers_, reader.start_ns);
    if (newest == kNothing || reader.seen == 0) {
      return kNothing;
    }
    const std::ptrdiff_t oldest = oldest_of(newest);
    if (oldest != known_ && newest - oldest < kSettled) {
      return kNothing;
    }
    std::ptrdiff_t found = kNothing;
    int versions = 0;
    for (std::ptrdiff_t i = newest; i >= oldest; --i) {
      const bool first = i == oldest || at(writers_, i - 1).left != at(writers_, i).left;
      if (at(writers_, i).left == reader.seen && first) {
        found = i;
        ++versions;
      }
    }
    if (versions != 1) {
      return versions > 1 ? kRepeated : kForeign;
    }
    known_ = found;
    return is_clear(found, newest) ? found : kRepeated;
  }

 private:
  // If the next run wrote the same value, the two cannot be distinguished; nor does it matter if both saw the same.
  [[nodiscard]] bool is_clear(std::ptrdiff_t found, std::ptrdiff_t newest) const {
    for (std::ptrdiff_t next = found + 1; next <= newest; ++next) {
      if (!is_followed(writers_, next - 1)) {
        return false;
      }
      if (at(writers_, next).left != at(writers_, found).left) {
        return true;
      }
      const auto origin = [&](std::ptrdiff_t run) { return origins_[static_cast<std::size_t>(run)]; };
      if (origins_.empty() || origin(next) < 0 || origin(next) != origin(found)) {
        return false;
      }
    }
    return true;
  }
  // Returns where the search begins: at the run that was seen before, but not across missing runs.
  [[nodiscard]] std::ptrdiff_t oldest_of(std::ptrdiff_t newest) const {
    const std::ptrdiff_t least = std::max({known_, newest - kBack, std::ptrdiff_t{0}});
    std::ptrdiff_t oldest = newest;
    while (oldest > least && is_followed(writers_, oldest - 1)) {
      --oldest;
    }
    return oldest;
  }

  const std::vector<ChainRun>& writers_;
  const std::vector<std::ptrdiff_t>& origins_;
  std::ptrdiff_t known_ = kNothing;
};

std::vector<std::ptrdiff_t> trace_back(const ChainStage& from, const std::vector<std::ptrdiff_t>& origins,
                                       const ChainStage& to) {
  std::vector<std::ptrdiff_t> seen;
  seen.reserve(to.runs.size());
  Travelled travelled(from.runs, origins);
  for (const ChainRun& run : to.runs) {
    seen.push_back(from.leaves ? travelled.seen(run) : seen_here(from.runs, run));
  }
  return seen;
}

}  // namespace

ChainAges follow_chain(std::span<const ChainStage> stages) {
  std::vector<std::vector<std::ptrdiff_t>> seen;  // by stage but the first: index of a run of the stage before
  for (std::size_t i = 1; i < stages.size(); ++i) {
    seen.push_back(trace_back(stages[i - 1], i == 1 ? std::vector<std::ptrdiff_t>() : seen[i - 2], stages[i]));
  }
  ChainAges ages;
  const std::vector<ChainRun>& last = stages.back().runs;
  for (std::size_t i = 0; i < last.size(); ++i) {
    auto run = static_cast<std::ptrdiff_t>(i);
    for (std::size_t stage = seen.size(); stage-- > 0 && run >= 0;) {
      run = seen[stage][static_cast<std::size_t>(run)];
    }
    if (run >= 0) {
      ages.samples.push_back({at(stages.front().runs, run).release_ns, last[i].release_ns});
    }
    ages.foreign += run == kForeign ? 1U : 0U;
    ages.repeated += run == kRepeated ? 1U : 0U;
    ages.unread += run == kNothing ? 1U : 0U;
  }
  return ages;
}

Keeping keeping_of(const Facts& facts) {
  Keeping keeping;
  keeping.longest_ns.resize(facts.modules.size());
  std::vector<const RunFact*> previous(facts.modules.size(), nullptr);
  std::vector<const RunFact*> good;
  for (const RunFact& run : facts.runs) {
    const std::int64_t period = facts.modules[run.module].period_ns;
    if (period == 0) {
      continue;
    }
    const RunFact* const before = previous[run.module];
    previous[run.module] = &run;
    if (run.end_ns > run.release_ns + period) {
      keeping.disturbed.push_back({run.release_ns, run.end_ns});
    } else {
      good.push_back(&run);
    }
    if (before != nullptr && run.release_ns > before->release_ns + period) {
      keeping.disturbed.push_back({before->release_ns + period, run.release_ns});
    }
  }
  std::sort(keeping.disturbed.begin(), keeping.disturbed.end(),
            [](const auto& a, const auto& b) { return a.from_ns < b.from_ns; });
  std::map<std::int32_t, Timeline> timelines;
  std::map<std::pair<std::int32_t, std::int64_t>, std::int64_t> first;  // core and release, begin
  for (const RunFact* run : good) {
    const std::int32_t core = facts.modules[run->module].core;
    const Timeline& timeline = timelines.try_emplace(core, facts, core).first->second;
    if (was_disturbed(keeping, {run->release_ns, run->end_ns})) {
      continue;
    }
    const Shares shares = timeline.shares({run->start_ns, run->end_ns});
    const auto own = shares.find(run->module);
    std::int64_t& longest = keeping.longest_ns[run->module];
    longest = std::max(longest, own == shares.end() ? 0 : own->second);
    const auto begun = first.try_emplace({core, run->release_ns}, run->start_ns).first;
    begun->second = std::min(begun->second, run->start_ns);
  }
  for (const auto& [release, start] : first) {
    keeping.late_ns = std::max(keeping.late_ns, start - release.second);
  }
  return keeping;
}

bool was_disturbed(const Keeping& keeping, const ChainSample& sample) {
  return std::any_of(keeping.disturbed.begin(), keeping.disturbed.end(), [&](const Keeping::Disturbed& one) {
    return one.from_ns <= sample.to_ns && one.to_ns >= sample.from_ns;
  });
}

}  // namespace indurop::explain
