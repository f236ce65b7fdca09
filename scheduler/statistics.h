// SPDX-License-Identifier: Apache-2.0
// Accounting of one run of a module: jitter by Eq. (1), execution, response and latency. No allocation, no lock; the
// thread that runs (or, for processes, releases) the module is the only writer.

#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "core/rt/relaxed.h"
#include "scheduler/run_block.h"

namespace indurop::scheduler {

// Adds to a counter that the calling thread alone changes.
inline void count(std::atomic<std::uint64_t>& counter, std::uint64_t by = 1) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

inline void add_sample(Distribution& to, std::int64_t value) noexcept {
  using rt::kRelaxed;
  const std::int64_t positive = value < 0 ? 0 : value;
  const std::uint64_t counted = to.count.load(kRelaxed);
  if (counted == 0 || positive < to.min.load(kRelaxed)) {
    to.min.store(positive, kRelaxed);
  }
  if (positive > to.max.load(kRelaxed)) {
    to.max.store(positive, kRelaxed);
  }
  to.sum.store(to.sum.load(kRelaxed) + positive, kRelaxed);
  to.histogram.add(static_cast<std::uint64_t>(positive));
  to.count.store(counted + 1, kRelaxed);
}

// J_n = T_0 + n * period - T_n with T_0 the first execution. One late first execution would shift every J_n, so the
// reference is the median of the first kSamples executions, each moved back to its own place on the grid.
class JitterReference {
 public:
  static constexpr std::size_t kSamples = 8;
  // `offset` = T_n minus the grid time of release n. Records |J_n|, delayed for the first kSamples runs; all are
  // counted.
  void add(Distribution& jitter, std::int64_t offset) noexcept;
  // At the end of a run with fewer executions: records the samples held back.
  void flush(Distribution& jitter) noexcept;

 private:
  std::array<std::int64_t, kSamples> first_{};
  std::size_t held_ = 0;
  bool known_ = false;
  std::int64_t reference_ = 0;
};

struct RunTimes {
  std::int64_t release_ns;
  std::int64_t start_ns;
  std::int64_t end_ns;
};

// Updates the module's record from one finished run. Real-time safe.
void account_run(ModuleRecord& record, JitterReference& reference, const RunTimes& times) noexcept;

// Entries for the rings of the run block. Real-time safe, any thread.
struct SlotLogLine {
  std::uint64_t tick;
  std::uint32_t module;
  RunTimes times;
};
void log_slot(RunBlock& block, const SlotLogLine& line) noexcept;

struct OverrunLine {
  std::uint64_t tick;
  std::uint32_t module;
  std::int64_t own_ns;
  std::int64_t latency_ns;
  std::int32_t previous;
  std::int64_t previous_ns;
  bool started;
};
void log_overrun(RunBlock& block, const OverrunLine& line) noexcept;

}  // namespace indurop::scheduler
