// SPDX-License-Identifier: Apache-2.0
#include "control/plc/network/chart_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

namespace indurop::plc::network {
namespace {

using Active = std::vector<std::size_t>;  // the active steps, in order: few of a long chart

// Charts with more situations than this are checked only partly.
constexpr std::size_t kMostSituations = 5'000;
constexpr std::size_t kMostSteps = 50'000'000;  // checked in all situations together

class ReachWalk {
 public:
  explicit ReachWalk(const Chart& chart)
      : chart_(chart), leaving_(chart.steps.size()), reached_(chart.steps.size()), twice_(chart.steps.size()) {
    for (std::size_t i = 0; i < chart.transitions.size(); ++i) {
      const auto& from = chart.transitions[i].from;
      std::vector<std::size_t>& of = from.empty() ? always_ : leaving_[from.front()];
      of.push_back(i);
    }
  }

  void run() {
    Active first;
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      if (chart_.steps[i].initial) {
        first.push_back(i);
      }
    }
    enter(first);
    for (; !left_.empty() && seen_.size() < kMostSituations && steps_taken_ < kMostSteps; left_.pop_front()) {
      for (const std::size_t transition : candidates(left_.front())) {
        fire(chart_.transitions[transition], left_.front());
      }
    }
  }

  [[nodiscard]] bool complete() const { return left_.empty(); }
  [[nodiscard]] bool reached(std::size_t step) const { return reached_[step]; }
  [[nodiscard]] bool twice(std::size_t step) const { return twice_[step]; }

 private:
  // Returns the transitions whose first step is active, in their order.
  std::vector<std::size_t> candidates(const Active& active) {
    std::vector<std::size_t> out = always_;
    for (const std::size_t step : active) {
      out.insert(out.end(), leaving_[step].begin(), leaving_[step].end());
    }
    std::sort(out.begin(), out.end());
    steps_taken_ += out.size();
    return out;
  }

  void fire(const Transition& transition, const Active& before) {
    const auto active = [&](std::size_t step) { return std::binary_search(before.begin(), before.end(), step); };
    if (!std::all_of(transition.from.begin(), transition.from.end(), active)) {
      return;
    }
    const auto ends = [&](std::size_t step) {
      return std::find(transition.from.begin(), transition.from.end(), step) != transition.from.end();
    };
    Active now;
    std::remove_copy_if(before.begin(), before.end(), std::back_inserter(now), ends);
    for (const std::size_t step : transition.to) {
      const auto at = std::lower_bound(now.begin(), now.end(), step);
      if (at != now.end() && *at == step) {
        twice_[step] = true;
      } else {
        now.insert(at, step);
      }
    }
    enter(std::move(now));
  }

  void enter(Active situation) {
    steps_taken_ += situation.size();
    for (const std::size_t step : situation) {
      reached_[step] = true;
    }
    if (seen_.insert(situation).second) {
      left_.push_back(std::move(situation));
    }
  }

  const Chart& chart_;
  std::vector<std::vector<std::size_t>> leaving_;  // transitions by their first step
  std::vector<std::size_t> always_;                // transitions without a step before them
  std::vector<bool> reached_;
  std::vector<bool> twice_;
  std::set<Active> seen_;
  std::deque<Active> left_;
  std::size_t steps_taken_ = 0;
};

}  // namespace

void warn_about_reach(const Chart& chart, Diagnostics& diagnostics) {
  if (std::none_of(chart.steps.begin(), chart.steps.end(), [](const Step& step) { return step.initial; })) {
    return;  // reported as an error elsewhere
  }
  ReachWalk walk(chart);
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
