// SPDX-License-Identifier: Apache-2.0
#include "scheduler/statistics.h"

#include <utility>

#include "core/rt/relaxed.h"

namespace indurop::scheduler {
namespace {

std::int64_t magnitude(std::int64_t value) noexcept {
  return value < 0 ? -value : value;
}

std::uint64_t slot_of(const RunBlock& block, std::uint64_t tick) noexcept {
  return block.slot_count == 0 ? 0 : tick % block.slot_count;
}

}  // namespace

void JitterReference::add(Distribution& jitter, std::int64_t offset) noexcept {
  if (known_) [[likely]] {
    add_sample(jitter, magnitude(reference_ - offset));
    return;
  }
  first_[held_++] = offset;
  if (held_ == kSamples) {
    flush(jitter);
  }
}

void JitterReference::flush(Distribution& jitter) noexcept {
  if (known_ || held_ == 0) {
    return;
  }
  auto sorted = first_;
  for (std::size_t i = 1; i < held_; ++i) {
    for (std::size_t k = i; k > 0 && sorted[k - 1] > sorted[k]; --k) {
      std::swap(sorted[k - 1], sorted[k]);
    }
  }
  reference_ = sorted[(held_ - 1) / 2];
  known_ = true;
  for (std::size_t i = 0; i < held_; ++i) {
    add_sample(jitter, magnitude(reference_ - first_[i]));
  }
}

void account_run(ModuleRecord& record, JitterReference& reference, const RunTimes& times) noexcept {
  using rt::kRelaxed;
  const std::int64_t latency = times.start_ns - times.release_ns;
  const std::int64_t response = times.end_ns - times.release_ns;
  const std::int64_t exec = times.end_ns - times.start_ns;
  reference.add(record.jitter, latency);
  add_sample(record.latency, latency);
  add_sample(record.exec, exec);
  add_sample(record.response, response);
  record.last_exec_ns.store(exec, kRelaxed);
  record.runs.store(record.runs.load(kRelaxed) + 1, kRelaxed);
  if (record.deadline_ns > 0 && response > record.deadline_ns) {
    record.deadline_misses.store(record.deadline_misses.load(kRelaxed) + 1, kRelaxed);
  }
}

void log_slot(RunBlock& block, const SlotLogLine& line) noexcept {
  const std::uint64_t number = block.slot_log_next.fetch_add(1, std::memory_order_relaxed);
  auto& entry = block.at<SlotEntry>(block.slot_log_offset)[number & (block.slot_log_capacity - 1)];
  entry.sequence.store(0, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);
  entry.tick = line.tick;
  entry.slot = slot_of(block, line.tick);
  entry.module = line.module;
  entry.release_ns = line.times.release_ns;
  entry.start_ns = line.times.start_ns;
  entry.end_ns = line.times.end_ns;
  entry.sequence.store(number + 1, std::memory_order_release);
}

void log_overrun(RunBlock& block, const OverrunLine& line) noexcept {
  const std::uint64_t number = block.overrun_log_next.fetch_add(1, std::memory_order_relaxed);
  auto& entry = block.at<OverrunEntry>(block.overrun_log_offset)[number & (block.overrun_log_capacity - 1)];
  entry.sequence.store(0, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);
  entry.tick = line.tick;
  entry.slot = slot_of(block, line.tick);
  entry.module = line.module;
  entry.own_ns = line.own_ns;
  entry.latency_ns = line.latency_ns;
  entry.previous = line.previous;
  entry.previous_ns = line.previous_ns;
  entry.started = line.started ? 1 : 0;
  entry.sequence.store(number + 1, std::memory_order_release);
}

}  // namespace indurop::scheduler
