// SPDX-License-Identifier: Apache-2.0
// Decides when an agent reports its board: at once when that was requested, often while something changes, otherwise at
// a longer interval.

#pragma once

#include <chrono>
#include <cstdint>

#include "core/rt/clock.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

class ReportSchedule {
 public:
  static constexpr std::chrono::milliseconds kInterval{500};
  static constexpr std::chrono::milliseconds kIntervalWhileChanging{50};

  // The next report is due at once.
  void request() noexcept { requested_ = true; }

  // Returns whether a report is due, which then counts as sent. `faults`: of the node's modules so far.
  bool take_due(Phase phase, NodeCondition condition, std::uint64_t faults, rt::MonoTime now) noexcept {
    const bool changing = phase != Phase::Steady || condition != condition_ || faults != faults_;
    if (!requested_ && now - sent_ < (changing ? kIntervalWhileChanging : kInterval)) {
      return false;
    }
    requested_ = false;
    sent_ = now;
    condition_ = condition;
    faults_ = faults;
    return true;
  }

 private:
  bool requested_ = true;
  rt::MonoTime sent_;
  NodeCondition condition_ = NodeCondition::None;  // as reported last
  std::uint64_t faults_ = 0;
};

}  // namespace indurop::deploy
