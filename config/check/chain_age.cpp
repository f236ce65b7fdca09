// SPDX-License-Identifier: Apache-2.0
#include "config/check/chain_age.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

namespace indurop::config {
namespace {

using base::Nanos;

constexpr std::int64_t kMaxJobs = 200'000;

struct Job {
  Nanos release{};
  Nanos start{};  // with all executions at their maximum: no module begins or ends later
  Nanos end{};
};

bool one_core(const std::vector<Timed>& board) {
  return std::all_of(board.begin(), board.end(), [&](const Timed& one) { return one.core == board.front().core; });
}

// The schedule of one board from its start: modules earlier in the order preempt later ones.
class Jobs {
 public:
  // A chain of this many links looks back up to two macro periods for each link.
  Jobs(const std::vector<Timed>& board, std::size_t links) : board_(board), jobs_(board.size()) {
    const auto before = static_cast<std::int64_t>(2 * links + 1);
    std::int64_t macro = 1;
    Nanos last{};
    for (const Timed& one : board) {
      macro = std::lcm(std::min(macro, kMaxMacro), one.period.count());
      last = std::max(last, one.offset);
    }
    std::int64_t count = 0;
    for (const Timed& one : board) {
      count += (before + 2) * (macro / one.period.count());
    }
    known_ = macro < kMaxMacro && count < kMaxJobs;
    macro_ = Nanos(macro);
    begin_ = last + before * macro_;
    if (known_) {
      run(last + (before + 2) * macro_);
    }
    for (std::size_t i = 0; i < board.size(); ++i) {
      longest_.push_back(one_core(board) && known_ ? longest(i) : board[i].period);
    }
  }

  [[nodiscard]] bool known() const noexcept { return known_; }
  // Returns the jobs of a macro period in the steady state.
  [[nodiscard]] std::span<const Job> settled(std::size_t module) const {
    const auto& all = jobs_[module];
    const auto from = first_at(all, begin_);
    return std::span(all).subspan(from, first_at(all, begin_ + macro_) - from);
  }
  [[nodiscard]] const std::vector<Job>& all(std::size_t module) const { return jobs_[module]; }
  // Returns the longest time from release to end.
  [[nodiscard]] Nanos response(std::size_t module) const { return longest_[module]; }
  [[nodiscard]] Nanos latest_start(std::size_t module) const {
    return std::max(longest_[module] - board_[module].execution, Nanos::zero());
  }

 private:
  static constexpr std::int64_t kMaxMacro = 3'600'000'000'000;

  static std::size_t first_at(const std::vector<Job>& all, Nanos time) {
    return static_cast<std::size_t>(
        std::lower_bound(all.begin(), all.end(), time, [](const Job& job, Nanos t) { return job.release < t; }) -
        all.begin());
  }

  [[nodiscard]] Nanos longest(std::size_t module) const {
    Nanos most{};
    for (const Job& job : jobs_[module]) {
      most = std::max(most, job.end - job.release);
    }
    return most;
  }

  void run(Nanos until) {
    struct Release {
      Nanos time;
      std::size_t module;
    };
    std::vector<Release> releases;
    for (std::size_t i = 0; i < board_.size(); ++i) {
      for (Nanos time = board_[i].offset; time < until; time += board_[i].period) {
        releases.push_back({time, i});
        jobs_[i].push_back({time, Nanos{-1}, time});
      }
    }
    std::stable_sort(releases.begin(), releases.end(),
                     [](const Release& a, const Release& b) { return a.time < b.time; });
    std::set<std::pair<std::size_t, std::size_t>> ready;  // module, job
    std::vector<std::size_t> next(board_.size());
    std::vector<Nanos> left(board_.size());
    Nanos now{};
    for (std::size_t i = 0; i < releases.size() || !ready.empty();) {
      if (ready.empty()) {
        now = std::max(now, releases[i].time);
      }
      for (; i < releases.size() && releases[i].time <= now; ++i) {
        ready.insert({releases[i].module, next[releases[i].module]++});
      }
      const auto [module, number] = *ready.begin();
      Job& job = jobs_[module][number];
      if (job.start < Nanos::zero()) {
        job.start = now;
        left[module] = board_[module].execution;
      }
      const Nanos stop = i < releases.size() ? std::min(releases[i].time, now + left[module]) : now + left[module];
      left[module] -= stop - now;
      now = stop;
      if (left[module] == Nanos::zero()) {
        job.end = now;
        ready.erase(ready.begin());
      }
    }
  }

  const std::vector<Timed>& board_;
  std::vector<std::vector<Job>> jobs_;
  std::vector<Nanos> longest_;
  Nanos macro_{};
  Nanos begin_{};
  bool known_ = false;
};

// The newest run of `writer` that a run of `reader` has certainly seen, and the newest that it may have seen.
class Seen {
 public:
  Seen(const Jobs& jobs, bool alone, std::size_t writer, std::size_t reader)
      : jobs_(jobs), alone_(alone), writer_(writer), reader_(reader) {}

  [[nodiscard]] const Job* sure(const Job& reading) const {
    return newest([&](const Job& written) {
      if (writer_ < reader_) {
        return written.release <= reading.release;
      }
      const Nanos end = alone_ ? written.end : written.release + jobs_.response(writer_);
      return written.release < reading.release && end <= reading.release;
    });
  }
  [[nodiscard]] const Job* possible_writer(const Job& reading) const {
    const Nanos start = alone_ ? reading.start : reading.release + jobs_.latest_start(reader_);
    return newest([&](const Job& written) {
      return writer_ < reader_ ? written.release <= start
                               : written.release < (alone_ ? reading.release : std::max(start, reading.release));
    });
  }

 private:
  // Releases rise, so does what is true of earlier ones.
  template <class Condition>
  [[nodiscard]] const Job* newest(Condition condition) const {
    const auto& all = jobs_.all(writer_);
    const auto end = std::partition_point(all.begin(), all.end(), condition);
    return end == all.begin() ? nullptr : &*std::prev(end);
  }

  const Jobs& jobs_;
  bool alone_;
  std::size_t writer_;
  std::size_t reader_;
};

struct Ages {
  Nanos least{};
  Nanos most{};
};

// Returns the ages from the first to the last of these modules of one board, over a macro period.
Ages within(const Jobs& jobs, bool alone, std::span<const ChainLink> links, const std::vector<Timed>& board) {
  if (links.size() == 1) {
    return {};
  }
  if (!jobs.known()) {
    Ages bound;
    for (std::size_t i = 0; i + 1 < links.size(); ++i) {
      bound.most += board[links[i].module].period + jobs.response(links[i].module);
      bound.least -= jobs.latest_start(links[i + 1].module);
    }
    return bound;
  }
  std::optional<Ages> ages;
  for (const Job& last : jobs.settled(links.back().module)) {
    const Job* oldest = &last;
    const Job* newest = &last;
    for (std::size_t i = links.size() - 1; i-- > 0 && oldest != nullptr && newest != nullptr;) {
      const Seen seen(jobs, alone, links[i].module, links[i + 1].module);
      oldest = seen.sure(*oldest);
      newest = seen.possible_writer(*newest);
    }
    if (oldest == nullptr || newest == nullptr) {
      continue;
    }
    const Ages now{last.release - newest->release, last.release - oldest->release};
    ages = ages ? Ages{std::min(ages->least, now.least), std::max(ages->most, now.most)} : now;
  }
  return ages.value_or(Ages{});
}

// Returns the time between two values that leave the board.
Nanos sent_every(const Timed& module, Nanos every) {
  const Nanos rest = every % module.period;
  const Nanos whole = rest > Nanos::zero() ? every - rest + module.period : every;
  return std::max(module.period, whole);
}

}  // namespace

ChainAge chain_age(std::span<const std::vector<Timed>> boards, std::span<const ChainLink> links,
                   const NetworkShare& network) {
  ChainAge age;
  std::vector<Jobs> jobs;
  for (const std::vector<Timed>& board : boards) {
    jobs.emplace_back(board, links.size());
  }
  for (std::size_t begin = 0; begin < links.size();) {
    const std::size_t board = links[begin].board;
    std::size_t end = begin + 1;
    while (end < links.size() && links[end].board == board) {
      ++end;
    }
    const bool alone = one_core(boards[board]);
    const Ages part = within(jobs[board], alone, links.subspan(begin, end - begin), boards[board]);
    age.least += part.least;
    age.most += part.most;
    age.exact = age.exact && alone && jobs[board].known();
    if (end < links.size()) {
      const ChainLink& from = links[end - 1];
      const ChainLink& to = links[end];
      age.most += sent_every(boards[from.board][from.module], from.every) + jobs[from.board].response(from.module) +
                  network.most;
      age.least += network.least - jobs[to.board].latest_start(to.module);
      age.exact = false;
      ++age.crossings;
    }
    begin = end;
  }
  age.least = std::max(age.least, Nanos::zero());
  age.most = std::max(age.most, Nanos::zero());
  return age;
}

}  // namespace indurop::config
