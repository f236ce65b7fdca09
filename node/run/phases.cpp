// SPDX-License-Identifier: Apache-2.0
#include "node/run/phases.h"

#include <atomic>
#include <cstring>
#include <string_view>

#include "core/rt/clock.h"
#include "core/rt/copy_text.h"
#include "scheduler/execution_order.h"

namespace indurop::node {
namespace {

constexpr std::chrono::milliseconds kPhasePoll{1};
constexpr std::size_t kPhaseStack = std::size_t{8} * 1024 * 1024;

}  // namespace

// The scheduler's runner contains faults; this is one of its runs without a schedule and without statistics.
struct Phases::Call {
  Call(scheduler::RunBlock& run, scheduler::Kernel& kernel, const scheduler::Hooks& hooks)
      : runner(run, kernel, hooks, trace, 1) {}
  std::uint32_t index = 0;
  const char* phase = "";
  scheduler::CoreTrace trace;
  scheduler::ModuleRecord scratch{};
  scheduler::TaskState state;
  scheduler::Runner runner;
  std::atomic<bool> done{false};
  bool reported = false;
  rt::MonoTime began = rt::MonoClock::now();
  rt::Thread thread;
};

Phases::Phases(const config::Config& config, scheduler::RunBlock& run, const std::vector<ModuleLibrary>& libraries,
               Console& console, base::StopSignal& signals, const scheduler::Hooks& hooks, scheduler::Kernel& kernel)
    : config_(config),
      run_(run),
      libraries_(libraries),
      console_(console),
      signals_(signals),
      hooks_(hooks),
      kernel_(kernel) {}

bool Phases::call_all(const char* phase, void (*ModuleDescriptor::*function)()) {
  bool ok = true;
  for (const std::uint32_t i : scheduler::execution_order(
           config_.modules.size(), [this](std::uint32_t module) { return config_.modules[module].priority; })) {
    const bool stopped = run_.modules()[i].state.load() == scheduler::ModuleState::Stopped;
    if (auto* wanted = libraries_[i].functions().*function; wanted != nullptr && !stopped) {
      ok = call(i, phase, wanted) && ok;
    }
  }
  return ok;
}

Phases::CallPointer Phases::begin(std::uint32_t index, const char* phase, void (*function)()) {
  CallPointer call(new Call(run_, kernel_, hooks_), [](Call* over) { delete over; });
  call->index = index;
  call->phase = phase;
  call->state.task.index = index;
  call->state.task.run = function;
  call->state.record = &call->scratch;
  call->state.logged = false;
  auto thread = rt::Thread::start({"irp-phase", 0, -1, kPhaseStack}, [this, &one = *call] {
    const rt::HandlerStack handler_stack;
    one.runner.attach_thread();
    scheduler::TaskState* const only[] = {&one.state};
    one.runner.run(only, 0, kernel_.now());
    one.runner.detach_thread();
    one.done.store(true, std::memory_order_release);
  });
  if (!thread) {
    console_.about(config_.modules[index].name)
        .error("module {}: {}() could not be called: no thread ({})", config_.modules[index].name, phase,
               std::strerror(thread.error().sys_errno));
    return {nullptr, [](Call* /*none*/) {}};
  }
  call->thread = std::move(thread).value();
  return call;
}

bool Phases::ended(Call& call, rt::MonoTime now, std::chrono::nanoseconds limit) {
  if (call.done.load(std::memory_order_acquire)) {
    return true;
  }
  if (limit.count() != 0 && now - call.began > limit) {
    call.runner.enforce_budget(now, true, 1);
  } else if (!call.reported && now - call.began > kGrace) {
    console_.about(config_.modules[call.index].name)
        .warning("module {}: {}() has not returned for {} s", config_.modules[call.index].name, call.phase,
                 kGrace.count());
    call.reported = true;
  }
  return false;
}

std::optional<std::string> Phases::failure_of(CallPointer call) {
  call->thread.join();
  return call->state.is_closed() ? std::optional(fmt::format("{}() failed: {}", call->phase, call->scratch.last_fault))
                                 : std::nullopt;
}

bool Phases::conclude(CallPointer call) {
  scheduler::ModuleRecord& record = run_.modules()[call->index];
  const auto failure = failure_of(std::move(call));
  if (!failure) {
    return true;
  }
  rt::copy_text(record.last_fault, *failure);
  record.fault_kind.store(static_cast<std::uint32_t>(scheduler::FaultKind::StartFailed));
  record.state.store(scheduler::ModuleState::Faulted);
  record.faults.fetch_add(1, std::memory_order_release);
  return false;
}

bool Phases::call(std::uint32_t index, const char* phase, void (*function)()) {
  CallPointer call = begin(index, phase, function);
  if (call == nullptr) {
    return false;
  }
  // start() has no limit until the node is to end; stop() always has a limit.
  std::chrono::nanoseconds limit{std::string_view(phase) == "stop" ? kGrace : std::chrono::seconds{0}};
  while (!ended(*call, rt::MonoClock::now(), limit)) {
    const int number = signals_.wait(kPhasePoll);
    console_.report(rt::MonoClock::now(), false);
    if (number != 0 && limit.count() == 0) {
      limit = rt::MonoClock::now() - call->began + kGrace;
    }
  }
  return conclude(std::move(call));
}

}  // namespace indurop::node
