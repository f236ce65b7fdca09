// SPDX-License-Identifier: Apache-2.0
#include "tools/client/scope/sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/client/history/known_tracks.h"

namespace indurop::tools {
namespace {

using base::Problem;

}  // namespace

Result<TickSampler, Problem> TickSampler::create(tape::Follower follower, const RunView& run, const vars::Store& store,
                                                 const std::vector<ScopeInput>& inputs) {
  TickSampler sampler(std::move(follower), inputs);
  sampler.epoch_ns_ = run.block().epoch_ns;
  sampler.period_ns_ = std::max<std::int64_t>(run.block().basic_period_ns, 1);
  sampler.values_.assign(inputs.size(), std::nan(""));
  if (auto chosen = sampler.choose_tracks(run, store); !chosen) {
    return std::move(chosen).error();
  }
  return sampler;
}

Result<void, Problem> TickSampler::choose_tracks(const RunView& run, const vars::Store& store) {
  std::vector<std::vector<std::vector<std::uint32_t>>> wanted(follower_.tracks());
  const auto directory = store.directory();
  for (std::uint32_t input = 0; input < inputs_.size(); ++input) {
    const auto entry = std::find_if(directory.begin(), directory.end(), [&](const vars::DirectoryEntry& one) {
      return one.schema_index == inputs_[input].variable;
    });
    const auto variable = static_cast<std::uint32_t>(entry - directory.begin());
    const std::string& name = store.schema().variables[inputs_[input].variable].name;
    if (variable >= follower_.variables().size()) {
      return Problem{fmt::format("{} appeared while the node runs; its tape has it after a restart", name)};
    }
    const auto tracks = known_tracks(follower_, run, variable);
    if (tracks.empty()) {
      return Problem{fmt::format("{} is too large for the tape; start the node with a larger --tape", name)};
    }
    for (const std::size_t track : tracks) {
      wanted[track].resize(directory.size());
      wanted[track][variable].push_back(input);
    }
  }
  // The track that runs most often shows up to which time the node has run.
  std::size_t fastest = 0;
  for (std::size_t track = 0; track < follower_.tracks(); ++track) {
    if (track_period(run, follower_.module_of(track)) < track_period(run, follower_.module_of(fastest))) {
      fastest = track;
    }
  }
  for (std::size_t track = 0; track < follower_.tracks(); ++track) {
    if (track == fastest || !wanted[track].empty()) {
      wanted[track].resize(directory.size());
      tracks_.push_back({track, std::move(wanted[track])});
    }
  }
  return {};
}

void TickSampler::note(const tape::Run& run, const std::vector<std::vector<std::uint32_t>>& wanted) {
  for (const tape::Value& value : run.values) {
    const std::int64_t time = value.kind == tape::EntryKind::Before ? run.tail.start_ns : run.tail.end_ns;
    for (const std::uint32_t input : wanted[value.variable]) {
      events_.push_back({time, input, number_of(inputs_[input], value.bytes.data())});
    }
  }
  oldest_ns_ = newest_ns_ == 0 ? run.tail.start_ns : std::min(oldest_ns_, run.tail.start_ns);
  newest_ns_ = std::max(newest_ns_, run.tail.end_ns);
  longest_ns_ = std::max(longest_ns_, run.tail.end_ns - run.tail.release_ns);
}

void TickSampler::take() {
  events_.erase(events_.begin(), events_.begin() + static_cast<std::ptrdiff_t>(used_));
  used_ = 0;
  lost_ = 0;
  for (const Track& one : tracks_) {
    while (follower_.next(one.track, run_)) {
      note(run_, one.wanted);
    }
    lost_ += follower_.lost(one.track);
  }
  std::stable_sort(events_.begin(), events_.end(),
                   [](const Event& a, const Event& b) { return a.time_ns < b.time_ns; });
}

std::span<const double> TickSampler::next(std::uint64_t& tick) {
  if (newest_ns_ == 0) {
    return {};
  }
  if (!begun_) {
    begun_ = true;
    next_tick_ = static_cast<std::uint64_t>(std::max<std::int64_t>((oldest_ns_ - epoch_ns_) / period_ns_, 0));
  }
  // Runs become visible when they end: one that is still running may change a value of an earlier tick.
  constexpr std::int64_t kLeastNs = 2'000'000;
  const std::int64_t patience = std::max({kLeastNs, 2 * period_ns_, 2 * longest_ns_});
  const std::int64_t end = time_of(next_tick_ + 1);
  if (end > newest_ns_ - patience) {
    return {};
  }
  for (; used_ < events_.size() && events_[used_].time_ns < end; ++used_) {
    values_[events_[used_].input] = events_[used_].value;
  }
  tick = next_tick_++;
  return values_;
}

}  // namespace indurop::tools
