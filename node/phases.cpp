// SPDX-License-Identifier: Apache-2.0
#include "node/phases.h"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "rt/clock.h"

namespace indurop::node {
namespace {

constexpr std::int64_t kLookNs = 1'000'000;
constexpr std::int64_t kGraceNs = 3'000'000'000;
constexpr std::size_t kStackBytes = 8 * 1024 * 1024;

}  // namespace

Phases::Phases(const deploy::Config& config, scheduler::RunBlock& run, const std::vector<ModuleLibrary>& libraries,
               Console& console, StopSignal& signals, const scheduler::Hooks& hooks)
    : config_(config), run_(run), libraries_(libraries), console_(console), signals_(signals), hooks_(hooks) {}

bool Phases::call_all(const char* phase, void (*ModuleDescriptor::*function)()) {
  std::vector<std::uint32_t> order(config_.modules.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return config_.modules[a].priority < config_.modules[b].priority;
  });
  bool ok = true;
  for (const std::uint32_t i : order) {
    if (auto* wanted = libraries_[i].functions().*function; wanted != nullptr) {
      ok = call(i, phase, wanted) && ok;
    }
  }
  return ok;
}

bool Phases::call(std::uint32_t index, const char* phase, void (*function)()) {
  // The scheduler's runner contains faults; this is one run of it without a schedule and without statistics.
  scheduler::CoreTrace trace;
  scheduler::ModuleRecord scratch{};
  scheduler::TaskState state;
  state.task.index = index;
  state.task.run = function;
  state.record = &scratch;
  state.logged = false;
  scheduler::Runner runner(run_, clock_, hooks_, trace, 1);
  std::atomic<bool> done{false};
  auto thread = rt::Thread::start({"irp-phase", 0, -1, kStackBytes}, [&] {
    const rt::HandlerStack handler_stack;
    runner.attach_thread();
    scheduler::TaskState* const only[] = {&state};
    runner.run(only, 0, clock_.now());
    runner.detach_thread();
    done.store(true, std::memory_order_release);
  });
  if (!thread) {
    console_.error("module {}: {}() could not be called: no thread ({})", config_.modules[index].name, phase,
                   std::strerror(thread.error().sys_errno));
    return false;
  }
  wait_for_end(index, phase, runner, done);
  thread.value().join();
  if (state.enabled.load()) {
    return true;
  }
  scheduler::ModuleRecord& record = run_.modules()[index];
  fmt::format_to_n(record.last_fault, sizeof record.last_fault - 1, "{}() failed: {}", phase, scratch.last_fault);
  record.fault_kind.store(static_cast<std::uint32_t>(scheduler::FaultKind::StartFailed));
  record.state.store(scheduler::ModuleState::Faulted);
  record.faults.fetch_add(1, std::memory_order_release);
  return false;
}

void Phases::wait_for_end(std::uint32_t index, const char* phase, scheduler::Runner& runner,
                          const std::atomic<bool>& done) {
  // start() may take its time, until somebody wants the node to end; stop() has a limit in any case.
  const std::int64_t began = rt::now_ns();
  std::int64_t give_up = std::string_view(phase) == "stop" ? began + kGraceNs : 0;
  bool told = false;
  while (!done.load(std::memory_order_acquire)) {
    const int number = signals_.wait(kLookNs);
    const std::int64_t now = rt::now_ns();
    console_.report(now, false);
    if (number != 0 && give_up == 0) {
      give_up = now + kGraceNs;
    }
    if (give_up != 0 && now > give_up) {
      runner.enforce_budget(now, true, 1);
    } else if (!told && now - began > kGraceNs) {
      console_.warning("module {}: {}() has not returned for {} s; the node waits for it", config_.modules[index].name,
                       phase, kGraceNs / rt::kNanosPerSecond);
      told = true;
    }
  }
}

}  // namespace indurop::node
