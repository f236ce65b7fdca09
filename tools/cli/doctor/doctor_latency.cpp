// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/doctor/doctor_latency.h"

#include <atomic>

#include "core/rt/clock.h"
#include "core/rt/machine.h"
#include "core/rt/thread.h"
#include "scheduler/statistics.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {

LatencyResult measure_latency(const LatencyTest& test) {
  LatencyResult result;
  result.lateness = std::make_unique<scheduler::Distribution>();
  std::atomic<bool> stop{false};
  std::atomic<bool> real_time{false};
  scheduler::Distribution& lateness = *result.lateness;
  const std::int64_t begin = rt::now_ns() + test.period_ns;
  const std::int64_t end = begin + test.duration_ns;
  const auto body = [&lateness, &stop, &real_time, begin, end, period = test.period_ns] {
    real_time = rt::fifo_priority() > 0;
    rt::request_exact_timers();
    constexpr int kWarmUp = 20;
    int rounds = 0;
    for (std::int64_t next = begin; next < end && !stop.load(std::memory_order_relaxed);) {
      rt::sleep_until(next);
      const std::int64_t now = rt::now_ns();
      if (++rounds > kWarmUp) {
        scheduler::add_sample(lateness, now - next);
      }
      next += period * ((now - next) / period + 1);  // skipped periods are not made up for
    }
  };
  const auto idle = rt::ShortIdle::hold();  // as the node does; refused without the right
  constexpr int kPriority = 90;
  const auto cores = rt::allowed_cores();
  auto thread = rt::Thread::start(
      {.name = "doctor", .fifo_priority = kPriority, .core = cores.empty() ? -1 : cores.back()}, body);
  if (!thread.ok()) {
    return result;
  }
  while (rt::now_ns() < end && !interrupted()) {
    wait_until(end);
  }
  stop = true;
  thread.value().join();
  result.real_time = real_time;
  return result;
}

}  // namespace indurop::tools
