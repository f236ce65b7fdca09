// SPDX-License-Identifier: Apache-2.0
#include "tools/client/history/value_history.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>

#include "core/rt/clock.h"
#include "history/recording/omg_idl.h"
#include "tools/client/history/recorded_history.h"
#include "tools/client/history/tape_history.h"

namespace indurop::tools {
namespace {

// Two readings of the difference of two clocks differ by less, unless a clock was set.
constexpr std::int64_t kSameClocksNs = 10'000'000;

bool are_the_same(std::int64_t a_ns, std::int64_t b_ns) noexcept {
  return std::abs(a_ns - b_ns) < kSameClocksNs;
}

// CLOCK_REALTIME minus the node's time: the reading between the two nearest readings of the node's time.
std::int64_t measured_real_minus_node(const vars::Store& store) {
  constexpr int kReadings = 8;
  std::int64_t best = 0;
  std::int64_t shortest = std::numeric_limits<std::int64_t>::max();
  for (int i = 0; i < kReadings; ++i) {
    const std::int64_t before = rt::to_ns(store.now());
    const std::int64_t wall = rt::wall_ns();
    const std::int64_t after = rt::to_ns(store.now());
    if (after - before < shortest) {
      shortest = after - before;
      best = wall - before - shortest / 2;
    }
  }
  return best;
}

// The sources of one history and the times that each of them knows.
class HistorySources {
 public:
  HistorySources(const std::string& node, const vars::Store& store, const HistoryRequest& request, const TimeSpan& span,
                 std::int64_t real_minus_node_ns)
      : items_(history_items(store, request.items)),
        real_minus_node_ns_(real_minus_node_ns),
        tape_(TapeHistory::read(node, store, {items_, span, real_minus_node_ns})) {}

  void add(const std::vector<RecordedNode>& files, const TimeSpan& span) {
    for (const RecordedNode& file : files) {
      File one{&file, 0, file.span, {}};
      if (are_the_same(file.real_minus_node_ns, real_minus_node_ns_)) {
        one.shift_ns = real_minus_node_ns_ - file.real_minus_node_ns;
        one.span = {file.span.begin_ns + one.shift_ns, file.span.end_ns + one.shift_ns};
      }
      if (one.span.cut_to(span).empty()) {
        continue;
      }
      for (const HistoryItem& item : items_) {
        one.has.push_back(file.has(item.declared->name, recording::omg_idl(item.declared->type).text));
      }
      files_.push_back(std::move(one));
    }
  }

  // Times between which no source begins or ends, from the begin of the span to its end, with `from_ns` in it.
  [[nodiscard]] std::vector<std::int64_t> borders(const TimeSpan& span, std::int64_t from_ns) const {
    std::set<std::int64_t> times{span.begin_ns, from_ns, span.end_ns};
    const auto add = [&](const TimeSpan& one) {
      for (const std::int64_t time : {one.begin_ns, one.end_ns}) {
        if (span.has(time)) {
          times.insert(time);
        }
      }
    };
    for (std::size_t item = 0; tape_ && item < items_.size(); ++item) {
      add(tape_->span_of(item));
    }
    for (const File& file : files_) {
      add(file.span);
    }
    return {times.begin(), times.end()};
  }

  // Finds what is known between two neighbouring borders.
  HistoryFindings read(const TimeSpan& span, const RecordedRequest& limits) const {
    HistoryFindings found;
    found.complete_ns = span.end_ns;
    std::vector<std::vector<bool>> by_file(files_.size(), std::vector<bool>(items_.size(), false));
    for (std::uint32_t item = 0; item < items_.size(); ++item) {
      if (tape_ && tape_->span_of(item).has(span.begin_ns)) {
        tape_->take(item, span, found);
        continue;
      }
      const auto file = std::find_if(files_.begin(), files_.end(),
                                     [&](const File& one) { return one.has[item] && one.span.has(span.begin_ns); });
      if (file == files_.end()) {
        found.gaps.push_back({item, span});
      } else {
        by_file[static_cast<std::size_t>(file - files_.begin())][item] = true;
      }
    }
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (std::ranges::count(by_file[i], true) > 0) {
        read_file(files_[i], std::move(by_file[i]), span, limits, found);
      }
    }
    found.sort();
    return found;
  }

  // The last value of an item before a time up to which the tape knows it, however long ago it was.
  [[nodiscard]] std::optional<HistoryValue> taped_before(std::uint32_t item, std::int64_t time_ns) const {
    return tape_ && knows(tape_->span_of(item), {time_ns, time_ns}) ? tape_->last_before(item, time_ns) : std::nullopt;
  }
  // Returns true if the tape knows all items during this time and, with `before`, their last values before it.
  [[nodiscard]] bool tape_suffices(const TimeSpan& span, bool before) const {
    for (std::uint32_t item = 0; item < items_.size(); ++item) {
      if (!tape_ || !knows(tape_->span_of(item), span) || (before && !tape_->last_before(item, span.begin_ns))) {
        return false;
      }
    }
    return true;
  }
  // The time up to which all is known that will ever be known.
  [[nodiscard]] std::int64_t settled_ns() const {
    const std::int64_t now = rt::wall_ns();
    return tape_ ? std::min(tape_->settled_ns(), now) : now;
  }

 private:
  struct File {
    const RecordedNode* about = nullptr;
    std::int64_t shift_ns = 0;
    TimeSpan span;
    std::vector<bool> has;  // by item
  };

  static bool knows(const TimeSpan& known, const TimeSpan& span) noexcept {
    return known.begin_ns <= span.begin_ns && span.end_ns <= known.end_ns;
  }
  void read_file(const File& file, std::vector<bool> wanted, const TimeSpan& span, RecordedRequest limits,
                 HistoryFindings& found) const {
    limits.items = &items_;
    limits.wanted = std::move(wanted);
    limits.span = span;
    limits.shift_ns = file.shift_ns;
    HistoryFindings more = read_recorded(*file.about, limits);
    found.values.insert(found.values.end(), std::make_move_iterator(more.values.begin()),
                        std::make_move_iterator(more.values.end()));
    found.gaps.insert(found.gaps.end(), more.gaps.begin(), more.gaps.end());
    found.complete_ns = std::min(found.complete_ns, more.complete_ns);
  }

  std::vector<HistoryItem> items_;
  std::int64_t real_minus_node_ns_;
  std::optional<TapeHistory> tape_;
  std::vector<File> files_;
};

// Adds values before the history that are older than what was read of recordings.
void add_taped_before(const HistorySources& sources, std::size_t items, std::int64_t from_ns, PageBuilder& page) {
  for (std::uint32_t item = 0; item < items; ++item) {
    auto before = page.knows(item) ? std::nullopt : sources.taped_before(item, from_ns);
    if (before) {
      page.set_before(std::move(*before));
    }
  }
}

// What lies beyond the time up to which the findings are complete is left to the next page.
void cut_at_completion(HistoryFindings& found) {
  std::erase_if(found.values, [&](const HistoryValue& value) { return value.time_ns >= found.complete_ns; });
  for (HistoryGap& gap : found.gaps) {
    gap.span.end_ns = std::min(gap.span.end_ns, found.complete_ns);
  }
  std::erase_if(found.gaps, [](const HistoryGap& gap) { return gap.span.empty(); });
}

}  // namespace

// The same for all histories, so that a value always has the same time; another one after a clock was set.
std::int64_t ValueHistory::real_minus_node_of(const std::string& node, const vars::Store& store) {
  const std::int64_t now = measured_real_minus_node(store);
  std::int64_t& known = real_minus_node_ns_.try_emplace(node, now).first->second;
  known = are_the_same(known, now) ? known : now;
  return known;
}

HistoryPage ValueHistory::read(const std::string& node, const vars::Store& store, const HistoryRequest& request) {
  HistoryPosition start;
  start.real_minus_node_ns = real_minus_node_of(node, store);
  const bool from_now = request.span.begin_ns == kHistoryFromNow && !request.position;
  std::int64_t from = from_now ? rt::wall_ns() : request.span.begin_ns;
  start.at_ns = std::max<std::int64_t>(from - kHistoryRunUpNs, 0);
  start.seen.resize(request.items.size());
  if (request.position) {
    const std::int64_t measured = start.real_minus_node_ns;
    start = *request.position;
    start.real_minus_node_ns = are_the_same(start.real_minus_node_ns, measured) ? start.real_minus_node_ns : measured;
    from = start.at_ns;
  }
  TimeSpan span{start.at_ns, std::max(request.span.end_ns, from)};
  HistorySources sources(node, store, request, span, start.real_minus_node_ns);
  from = from_now ? std::clamp(sources.settled_ns(), start.at_ns, from) : from;
  span.end_ns = std::max(std::min(span.end_ns, sources.settled_ns()), from);
  std::vector<RecordedNode> files;
  // The tape knows only since when it has a value that has not changed for long; a recording may know when it changed.
  if (!request.follow || !sources.tape_suffices({from, span.end_ns}, !request.position)) {
    files = catalog_.of(node, folder_);
    sources.add(files, span);
  }

  PageBuilder page(std::move(start), from, {request.most, kMostHistoryBytes});
  const RecordedRequest limits{nullptr, {}, {}, 0, request.most, kMostHistoryMessages, from};
  const std::vector<std::int64_t> borders = sources.borders(span, from);
  for (std::size_t i = 0; i < borders.size(); ++i) {
    if (borders[i] == from && !request.position) {
      add_taped_before(sources, request.items.size(), from, page);
    }
    if (i + 1 == borders.size()) {
      break;
    }
    HistoryFindings found = sources.read({borders[i], borders[i + 1]}, limits);
    cut_at_completion(found);
    const bool whole = found.complete_ns == borders[i + 1];
    if (!page.add(std::move(found)) || !whole) {
      return page.finish(true);
    }
  }
  return page.finish(request.follow);
}

}  // namespace indurop::tools
