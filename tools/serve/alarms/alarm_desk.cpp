// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/alarms/alarm_desk.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "core/base/print.h"
#include "history/alarms/alarm_list.h"
#include "tools/client/node/node_trouble.h"

namespace indurop::serve {

void AlarmDesk::check(std::vector<std::string> boards) {
  (void)worker_.add_if_idle([this, boards = std::move(boards)] { check_now(boards); });
}

void AlarmDesk::check_now(const std::vector<std::string>& boards) {
  constexpr std::uint64_t kIdleRounds = 10;  // a board without alarms is checked every second
  ++round_;
  for (const std::string& board : boards) {
    auto& watch = watches_[board];
    if (watch == nullptr) {
      watch = std::make_unique<alarms::AlarmWatch>(board);
    } else if (watch->idle() && round_ % kIdleRounds != 0) {
      continue;
    }
    if (std::string problem = watch->evaluate(tools::modules_now(board)); problem != problem_) {
      problem_ = std::move(problem);
      if (!problem_.empty()) {
        base::print(stderr, "indurop-serve: error: alarms cannot be kept: {}\n", problem_);
      }
    }
    const alarms::AlarmBook& book = watch->journal().book();
    const std::lock_guard hold(lock_);
    Figures& figures = figures_[board];
    figures.counts = book.counts();
    figures.revision = book.revision();
  }
}

alarms::AlarmCounts AlarmDesk::counts(const std::string& board) const {
  const std::lock_guard hold(lock_);
  const auto found = figures_.find(board);
  return found == figures_.end() ? alarms::AlarmCounts{} : found->second.counts;
}

std::vector<std::string> AlarmDesk::news() {
  std::vector<std::string> words;
  const std::lock_guard hold(lock_);
  for (auto& [board, figures] : figures_) {
    if (figures.revision == figures.reported) {
      continue;
    }
    figures.reported = figures.revision;
    base::Json word{{"type", "alarms"}, {"board", board}};
    word.update(json_of(figures.counts));
    words.push_back(word.dump());
  }
  return words;
}

}  // namespace indurop::serve
