// SPDX-License-Identifier: Apache-2.0
// Overruns of a band: a module that has not ended when it is released again is counted and logged, and its policy says
// what follows.

#include <cstdio>

#include "core/rt/relaxed.h"
#include "scheduler/band.h"
#include "scheduler/statistics.h"

namespace indurop::scheduler {
namespace {

using rt::kRelaxed;

}  // namespace

void Band::overrun(const Release& release) noexcept {
  TaskState* running = runner_.current();
  TaskState& culprit = running != nullptr ? *running : *tasks_.front();
  const Release& unfinished = pending_[done_.load(std::memory_order_acquire) % kBacklog];
  record_overrun(culprit, release.tick, running != nullptr, rt::to_ns(unfinished.time));
}

void Band::record_overrun(TaskState& culprit, std::uint64_t tick, bool started, std::int64_t release_ns) noexcept {
  count(culprit.record->overruns);
  OverrunLine line{};
  line.tick = tick;
  line.module = culprit.task.index;
  line.started = started;
  if (started && plan_.kind != BandKind::Process) {
    const std::int64_t start = runner_.current_start();
    line.own_ns = rt::to_ns(kernel_.now()) - start;
    line.latency_ns = start - release_ns;
    line.previous = runner_.previous_module();
    line.previous_ns = runner_.previous_exec();
  } else {
    if (started) {
      const std::int64_t start = culprit.slot->start_ns.load(kRelaxed);
      line.own_ns = rt::to_ns(kernel_.now()) - start;
      line.latency_ns = start - release_ns;
    }
    line.previous = trace_.module.load(kRelaxed);
    line.previous_ns = trace_.exec_ns.load(kRelaxed);
  }
  log_overrun(block_, line);
  apply_policy(culprit, tick, line.own_ns);
}

void Band::find_inline_overrun(std::uint64_t tick, std::int64_t release_ns) noexcept {
  const std::int64_t next = release_ns + basic_period_ns_;
  std::size_t i = 0;
  while (i < running_.size() && runner_.times(i).end_ns <= next) {
    ++i;
  }
  if (i == running_.size()) [[likely]] {
    return;
  }
  // The first to pass the next release is the culprit; those after it were only delayed.
  TaskState& culprit = *running_[i];
  const RunTimes& times = runner_.times(i);
  count(culprit.record->overruns);
  OverrunLine line{tick, culprit.task.index, times.end_ns - times.start_ns, times.start_ns - release_ns, -1, 0, true};
  if (i > 0) {
    line.previous = static_cast<std::int32_t>(running_[i - 1]->task.index);
    line.previous_ns = runner_.times(i - 1).end_ns - runner_.times(i - 1).start_ns;
  }
  log_overrun(block_, line);
  apply_policy(culprit, tick, line.own_ns);
}

void Band::apply_policy(TaskState& culprit, std::uint64_t tick, std::int64_t own_ns) noexcept {
  const bool harmless = culprit.task.overrun != OverrunPolicy::StopModule;
  if (harmless && culprit.gate.load(std::memory_order_acquire) == Gate::Watched &&
      culprit.exchange->go_back(Exchange::Reason::Overrun)) {
    return;
  }
  if (culprit.task.overrun == OverrunPolicy::StopModule) {
    char text[kTextLength];
    std::snprintf(text, sizeof text, "overrun after %lld us (policy stop-module)",
                  static_cast<long long>(own_ns / 1000));
    quarantine(culprit, FaultKind::Overrun, tick, text, hooks_);
  } else if (culprit.task.overrun == OverrunPolicy::StopNode && hooks_.stop_node != nullptr) {
    hooks_.stop_node(hooks_.context, culprit.task.index, "overrun (policy stop-node)");
  }
}

}  // namespace indurop::scheduler
