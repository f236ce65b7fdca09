// SPDX-License-Identifier: Apache-2.0
// A schedule that counts no more, until no thread has its address: first its own runs have to be over, then the runs
// of the next schedule that might have seen it, and the watchdog's pass. Called by one normal thread.

#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scheduler/schedule.h"

namespace indurop::scheduler {

class Retirement {
 public:
  void begin(std::unique_ptr<Schedule> schedule) noexcept { schedule_ = std::move(schedule); }
  // The schedule that retires; null: none.
  [[nodiscard]] Schedule* schedule() const noexcept { return schedule_.get(); }

  // Returns true when none of its runs is in progress, or will be: from then on no new reader gets its address.
  [[nodiscard]] bool is_at_rest() const noexcept { return schedule_->is_at_rest(); }
  [[nodiscard]] bool is_closed() const noexcept { return closed_; }
  // Called then. `next`: the schedule that counts. `watchdog_passes`: so far.
  void close(const Schedule& next, std::uint64_t watchdog_passes);
  // Returns true when no reader has the address any more. Without watchdog: nothing is known of its passes.
  [[nodiscard]] bool is_over(const Schedule& next, std::uint64_t watchdog_passes, bool has_watchdog) const noexcept;
  // Ends its threads, and it.
  void end() noexcept;

 private:
  std::unique_ptr<Schedule> schedule_;
  bool closed_ = false;
  std::vector<std::uint64_t> releases_;  // of the bands of the next schedule, when it was closed
  std::uint64_t passes_ = 0;
};

}  // namespace indurop::scheduler
