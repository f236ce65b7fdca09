// SPDX-License-Identifier: Apache-2.0
// Timing of a verb that polls.

#pragma once

#include <algorithm>
#include <cstdint>

#include "core/rt/clock.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {

// Counts rounds and checks the limits; `count` and `timeout_ns` 0: no limit.
class Rounds {
 public:
  Rounds(double hz, std::uint64_t count, std::int64_t timeout_ns)
      : count_(count),
        interval_ns_(static_cast<std::int64_t>(1e9 / hz)),
        begin_ns_(rt::now_ns()),
        next_ns_(begin_ns_),
        end_ns_(timeout_ns > 0 ? begin_ns_ + timeout_ns : INT64_MAX) {}
  // Waits for the next round, or for `key_file` (then `key` is set). Returns true if another round follows.
  bool wait(int key_file, bool& key) {
    key = false;
    if (count_ > 0 && done_ >= count_) {
      return false;
    }
    const Woken why = wait_until(std::min(next_ns_, end_ns_), key_file);
    key = why == Woken::Readable;
    return !interrupted() && (rt::now_ns() < end_ns_ || next_ns_ <= end_ns_);
  }
  [[nodiscard]] bool due() const { return rt::now_ns() >= next_ns_; }
  void done() {
    ++done_;
    // Rounds are on a fixed grid; rounds missed because of a slow terminal are skipped.
    next_ns_ = std::max(next_ns_ + interval_ns_, rt::now_ns());
  }
  [[nodiscard]] std::int64_t elapsed_ns() const { return rt::now_ns() - begin_ns_; }

 private:
  std::uint64_t count_;
  std::int64_t interval_ns_;
  std::int64_t begin_ns_;
  std::int64_t next_ns_;
  std::int64_t end_ns_;
  std::uint64_t done_ = 0;
};

}  // namespace indurop::tools
