// SPDX-License-Identifier: Apache-2.0
#include "tools/client/history/tape_history.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "core/rt/clock.h"
#include "tools/client/history/known_tracks.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kLeastPatienceNs = 2'000'000;

// Returns true if the tape is that of the run, and this is one of a real node.
bool is_real(const tape::Follower& follower, const RunView& run) {
  return follower.header().node_start_time == run.block().node_start_time &&
         follower.header().node_pid == run.block().node_pid && run.block().virtual_ns == 0;
}

}  // namespace

void TapeHistory::note_value(std::uint32_t item, std::int64_t node_ns, std::span<const std::uint8_t> whole) {
  const std::span<const std::uint8_t> bytes = wanted_.items[item].part_of(whole);
  const std::int64_t time = wall_ns(node_ns);
  std::vector<HistoryValue>& values = items_[item].values;
  if (bytes.empty() || time >= wanted_.span.end_ns) {
    return;
  }
  if (time < wanted_.span.begin_ns && !values.empty() && values.back().time_ns <= time) {
    values.pop_back();
  }
  values.push_back({time, item, {bytes.begin(), bytes.end()}});
}

void TapeHistory::note(const tape::Run& run, const std::vector<std::uint32_t>& items) {
  for (const tape::Value& value : run.values) {
    const std::int64_t time = value.kind == tape::EntryKind::Before ? run.tail.start_ns : run.tail.end_ns;
    for (const std::uint32_t item : items) {
      if (wanted_.items[item].variable == value.variable) {
        note_value(item, time, value.bytes);
      }
    }
  }
  longest_ns_ = std::max(longest_ns_, run.tail.end_ns - run.tail.release_ns);
  newest_ns_ = std::max(newest_ns_, run.tail.end_ns);
}

void TapeHistory::read_track(tape::Follower& follower, std::size_t track, const std::vector<std::uint32_t>& items,
                             const RunView& run) {
  const std::int64_t epoch = run.block().epoch_ns;
  const auto begin_at = [&](std::int64_t node_ns) {
    for (const std::uint32_t item : items) {
      items_[item].span.begin_ns = std::max(items_[item].span.begin_ns, wall_ns(node_ns));
    }
  };
  tape::Run one;
  std::optional<tape::RunTail> before;
  while (follower.next(track, one)) {
    if (!before) {
      begin_at(one.tail.number == 0 ? epoch : one.tail.start_ns);
    } else if (one.tail.number != before->number + 1) {
      for (const std::uint32_t item : items) {
        items_[item].gaps.push_back({item, {wall_ns(before->end_ns) + 1, wall_ns(one.tail.start_ns)}});
      }
    }
    note(one, items);
    before = one.tail;
  }
  if (!before) {
    begin_at(follower.runs(track) == 0 ? epoch : run.now_ns());
  }
}

std::optional<TapeHistory> TapeHistory::read(const std::string& node, const vars::Store& store, const Wanted& wanted) {
  auto follower = tape::Follower::open(node, true);
  const auto run = RunView::open(node);
  if (!follower || !run || !is_real(*follower, *run)) {
    return std::nullopt;
  }
  const bool alive = run->node_alive();
  const std::int64_t now = run->now_ns();
  TapeHistory history(wanted);
  if (!follower->is_of(store)) {
    history.settled_ns_ = alive ? history.wall_ns(run->block().epoch_ns) : std::numeric_limits<std::int64_t>::max();
    return history;
  }
  std::map<std::size_t, std::vector<std::uint32_t>> by_track;
  for (std::uint32_t item = 0; item < wanted.items.size(); ++item) {
    const std::uint32_t variable = wanted.items[item].variable;
    const auto tracks = known_tracks(*follower, *run, variable);
    for (const std::size_t track : tracks) {
      by_track[track].push_back(item);
    }
    if (!tracks.empty()) {
      history.items_[item].span = {history.wall_ns(run->block().epoch_ns), std::numeric_limits<std::int64_t>::max()};
      history.note_value(item, run->block().epoch_ns, follower->first_value(variable));
    }
  }
  for (const auto& [track, items] : by_track) {
    history.read_track(*follower, track, items, *run);
  }
  history.settled_ns_ = alive ? history.wall_ns(now - std::max(kLeastPatienceNs, 2 * history.longest_ns_))
                              : std::numeric_limits<std::int64_t>::max();
  for (Known& known : history.items_) {
    known.span.end_ns = known.span.end_ns == 0 ? 0
                        : alive                ? history.settled_ns_
                                               : history.wall_ns(history.newest_ns_) + 1;
    std::erase_if(known.values, [&known](const HistoryValue& value) { return value.time_ns < known.span.begin_ns; });
    std::stable_sort(known.values.begin(), known.values.end(),
                     [](const HistoryValue& a, const HistoryValue& b) { return a.time_ns < b.time_ns; });
  }
  return history;
}

std::vector<bool> TapeHistory::held(const std::string& node, const vars::Store& store) {
  std::vector<bool> held(store.directory().size());
  const auto follower = tape::Follower::open(node, true);
  const auto run = RunView::open(node);
  if (!follower || !run || !is_real(*follower, *run) || !follower->is_of(store)) {
    return held;
  }
  for (std::size_t track = 0; track < follower->tracks(); ++track) {
    const tape::Follower::Items items = follower->items_of(track);
    for (const auto some : {items.only_read, items.written}) {
      for (const std::uint32_t variable : some) {
        held[variable] = follower->variables()[variable].taped != 0;
      }
    }
  }
  return held;
}

void TapeHistory::take(std::size_t item, const TimeSpan& span, HistoryFindings& to) const {
  for (const HistoryValue& value : items_[item].values) {
    if (span.has(value.time_ns)) {
      to.values.push_back(value);
    }
  }
  for (const HistoryGap& gap : items_[item].gaps) {
    if (const TimeSpan cut = gap.span.cut_to(span); !cut.empty()) {
      to.gaps.push_back({gap.item, cut});
    }
  }
}

std::optional<HistoryValue> TapeHistory::last_before(std::size_t item, std::int64_t time_ns) const {
  std::optional<HistoryValue> last;
  for (const HistoryValue& value : items_[item].values) {
    if (value.time_ns < time_ns) {
      last = value;
    }
  }
  return last;
}

}  // namespace indurop::tools
