// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/debug_back.h"

#include <algorithm>

#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

constexpr int kPollMs = 50;

// Where the module would have stopped after an answer (include/indurop/plc/debug.h).
class Halts {
 public:
  Halts(const DebugHistory::Answer& answer, std::size_t depth)
      : answer_(answer), limit_(answer.mode == DebugMode::Out ? depth - std::min<std::size_t>(depth, 1) : depth) {}

  [[nodiscard]] bool at(const DebugStop& stop) const {
    const bool over = answer_.mode == DebugMode::Over || answer_.mode == DebugMode::Out;
    return stop.kind != DebugStop::Kind::Line || answer_.mode == DebugMode::Into ||
           (over && stop.frames.size() <= limit_) ||
           std::binary_search(answer_.breakpoints.begin(), answer_.breakpoints.end(), stop.line);
  }

 private:
  const DebugHistory::Answer& answer_;
  std::size_t limit_;
};

}  // namespace

std::optional<DebugStop> DebugBack::wait() {
  while (!interrupted() && !node_.ended()) {
    if (auto stop = link_.wait(kPollMs)) {
      return stop;
    }
  }
  return std::nullopt;
}

// Starts the simulation again and goes to the stop that waits for this answer.
std::optional<DebugStop> DebugBack::go_to(std::uint64_t number, bool silent) {
  lost_ = true;
  const bool started = node_.start(silent);
  link_.release();
  if (!started) {
    return std::nullopt;
  }
  auto stop = wait();
  for (std::uint64_t i = 0; stop && i < number; ++i) {
    for (const std::string& assignment : history_.sets_at(i)) {
      (void)node_.set(assignment, true);
    }
    link_.answer(history_.at(i).mode, history_.at(i).breakpoints);
    stop = wait();
  }
  return stop;
}

// Goes through the scan that begins with the stop of answer `begin`, up to the stop of answer `end`. Returns false if
// that is not reached.
bool DebugBack::follow(std::uint64_t begin, std::uint64_t end, Trail& trail) {
  auto stop = go_to(begin, true);
  if (!stop || stop->kind != DebugStop::Kind::Begin) {
    return false;
  }
  std::uint64_t given = begin;
  std::optional<Halts> halts;
  while (stop) {
    if (stop->kind != DebugStop::Kind::Begin) {
      trail.stops.push_back(*stop);
    }
    if (!halts || halts->at(*stop)) {
      if (given == end) {
        trail.whole = stop->kind == DebugStop::Kind::Begin;
        return true;
      }
      for (std::string& assignment : history_.sets_at(given)) {
        (void)node_.set(assignment, true);
        trail.sets.emplace_back(trail.stops.size(), std::move(assignment));
      }
      halts.emplace(history_.at(given), stop->frames.size());
      ++given;
    }
    link_.answer(DebugMode::Into, {});
    stop = wait();
  }
  return false;
}

std::optional<std::size_t> DebugBack::begin_of_line_before(const Trail& trail) const {
  const auto begin_of = [&](std::size_t index) {
    while (index > 0 && same_line_(trail.stops[index - 1], trail.stops[index])) {
      --index;
    }
    return index;
  };
  if (trail.stops.empty()) {
    return std::nullopt;
  }
  const std::size_t last = begin_of(trail.stops.size() - 1);
  if (trail.whole) {
    return last;
  }
  return last > 0 ? std::optional(begin_of(last - 1)) : std::nullopt;
}

// Goes to a statement of a scan, one statement after the other, which is the history from then on.
std::optional<DebugStop> DebugBack::repeat(std::uint64_t begin, const Trail& trail, std::size_t target) {
  auto stop = go_to(begin, false);
  history_.cut(begin);
  history_.note_scan();
  for (std::size_t i = 0; stop && i <= target; ++i) {
    for (const auto& [before, assignment] : trail.sets) {
      if (before == i) {
        (void)node_.set(assignment, true);
        history_.add_set(assignment);
      }
    }
    history_.add({DebugMode::Into, {}});
    link_.answer(DebugMode::Into, {});
    stop = wait();
  }
  lost_ = !stop || stop->line != trail.stops[target].line;
  return lost_ ? std::nullopt : stop;
}

std::optional<DebugStop> DebugBack::line_before() {
  const std::vector<std::uint64_t> scans = history_.scans();
  std::uint64_t end = history_.size();
  for (auto begin = scans.rbegin(); begin != scans.rend(); ++begin) {
    Trail trail;
    if (!follow(*begin, end, trail)) {
      return std::nullopt;
    }
    if (const auto target = begin_of_line_before(trail)) {
      return repeat(*begin, trail, *target);
    }
    end = *begin;
  }
  const auto back = go_to(history_.size(), false);  // there is no earlier line
  lost_ = !back;
  return std::nullopt;
}

}  // namespace indurop::tools
