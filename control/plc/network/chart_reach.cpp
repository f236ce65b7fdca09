// SPDX-License-Identifier: Apache-2.0
#include "control/plc/network/chart_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <set>
#include <vector>

namespace indurop::plc::network {
namespace {

using Active = std::vector<bool>;  // by step

// Charts with more situations than this are checked only partly.
constexpr std::size_t kMostSituations = 5'000;
constexpr std::size_t kMostSteps = 50'000'000;  // checked in all situations together

class Walk {
 public:
  explicit Walk(const Chart& chart) : chart_(chart), reached_(chart.steps.size()), twice_(chart.steps.size()) {}

  void run() {
    Active first(chart_.steps.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      first[i] = chart_.steps[i].initial;
    }
    enter(first);
    for (; !left_.empty() && seen_.size() < kMostSituations && looked_at_ < kMostSteps; left_.pop_front()) {
      for (const Transition& transition : chart_.transitions) {
        fire(transition, left_.front());
      }
      looked_at_ += chart_.transitions.size();
    }
  }

  [[nodiscard]] bool complete() const { return left_.empty(); }
  [[nodiscard]] bool reached(std::size_t step) const { return reached_[step]; }
  [[nodiscard]] bool twice(std::size_t step) const { return twice_[step]; }

 private:
  void fire(const Transition& transition, const Active& before) {
    const auto active = [&](std::size_t step) { return static_cast<bool>(before[step]); };
    if (!std::all_of(transition.from.begin(), transition.from.end(), active)) {
      return;
    }
    Active now = before;
    for (const std::size_t step : transition.from) {
      now[step] = false;
    }
    for (const std::size_t step : transition.to) {
      twice_[step] = twice_[step] || now[step];
      now[step] = true;
    }
    enter(std::move(now));
  }

  void enter(Active situation) {
    looked_at_ += situation.size();
    for (std::size_t i = 0; i < situation.size(); ++i) {
      reached_[i] = reached_[i] || situation[i];
    }
    if (seen_.insert(situation).second) {
      left_.push_back(std::move(situation));
    }
  }

  const Chart& chart_;
  Active reached_;
  Active twice_;
  std::set<Active> seen_;
  std::deque<Active> left_;
  std::size_t looked_at_ = 0;
};

}  // namespace

void warn_about_reach(const Chart& chart, Diagnostics& diagnostics) {
  if (std::none_of(chart.steps.begin(), chart.steps.end(), [](const Step& step) { return step.initial; })) {
    return;  // reported as an error elsewhere
  }
  Walk walk(chart);
  walk.run();
  for (std::size_t i = 0; i < chart.steps.size(); ++i) {
    const Step& step = chart.steps[i];
    if (walk.complete() && !walk.reached(i)) {
      diagnostics.warning(step.element->at,
                          fmt::format("the step '{}' never becomes active; lead a transition to it", step.name));
    }
    if (walk.twice(i)) {
      diagnostics.warning(step.element->at,
                          fmt::format("the step '{}' can become active while it is active; end simultaneous sequences "
                                      "in one transition, and do not jump out of one of them",
                                      step.name));
    }
  }
}

}  // namespace indurop::plc::network
