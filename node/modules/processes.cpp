// SPDX-License-Identifier: Apache-2.0
#include "node/modules/processes.h"

#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <utility>

#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "node/modules/expected_signal.h"
#include "scheduler/runner.h"

namespace indurop::node {
namespace {

using scheduler::FaultKind;
using scheduler::ModuleState;
using scheduler::Operation;

constexpr std::chrono::seconds kProcessGrace{2};
constexpr std::chrono::milliseconds kAsked{500};  // after that: SIGTERM
constexpr std::chrono::milliseconds kPoll{5};
constexpr std::chrono::seconds kStartPatience{2};
constexpr std::size_t kRestartsKept = 1000;

}  // namespace

std::string describe_end(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
  }
  return fmt::format("exited with code {}", WEXITSTATUS(status));
}

Processes::Processes(const config::Config& config, scheduler::RunBlock& run, std::string node, bool realtime,
                     Console& console, FailSafe& failsafe, tape::Tape* tape)
    : run_(run), node_(std::move(node)), realtime_(realtime), console_(console), failsafe_(failsafe), tape_(tape) {
  for (std::uint32_t i = 0; i < config.modules.size(); ++i) {
    add(i, config.modules[i]);
  }
}

void Processes::add(std::uint32_t index, const config::Module& module) {
  if (module.type == scheduler::ModuleType::Process) {
    Child& child = children_.emplace_back();
    child.index = index;
    child.module = &module;
    child.program.file = module.file;
  }
}

Processes::~Processes() {
  end_all();
}

bool Processes::managed(const Child& child) const noexcept {
  return child.module->operation != Operation::NonReal && child.module->signal == 0;
}

bool Processes::enrolled(Child& child) {
  if (child.module->signal == 0) {
    return slot(child).pid.load(std::memory_order_acquire) == child.pid;
  }
  if (expects_signal(child.pid, child.module->signal)) {
    return true;
  }
  if (!child.warned && rt::MonoClock::now() - child.launched > kStartPatience) {
    child.warned = true;
    console_.about(record(child).name)
        .warning("module {} neither catches nor blocks {} ({}): it is not started until it does", record(child).name,
                 child.module->signal, ::strsignal(child.module->signal));
  }
  return false;
}

bool Processes::launch_all() {
  for (Child& child : children_) {
    if (!launch(child)) {
      return false;
    }
  }
  return true;
}

bool Processes::launch(Child& child) {
  if (!note_version(child)) {
    return false;
  }
  scheduler::ProcessSlot& at = slot(child);
  while (at.wake.try_wait()) {
  }
  at.done.store(at.released.load(std::memory_order_relaxed), std::memory_order_release);
  at.stop.store(0, std::memory_order_relaxed);
  at.pid.store(0, std::memory_order_relaxed);
  scheduler::ModuleRecord& module = record(child);
  module.state.store(ModuleState::Starting, std::memory_order_release);
  const auto started = launch_next_to(child.index, child.program.file);
  if (!started) {
    console_.about(module.name)
        .error("module {}: cannot be started: {}", module.name, std::strerror(started.error().sys_errno));
    return false;
  }
  child.pid = started.value();
  child.killed_for_budget = false;
  child.killed_hanging = false;
  child.warned = false;
  child.launched = rt::MonoClock::now();
  module.pid.store(child.pid, std::memory_order_release);
  if (child.module->signal != 0 && realtime_) {
    (void)rt::set_fifo_of(child.pid, module.fifo_priority);
  }
  if (child.module->operation == Operation::NonReal) {
    module.state.store(ModuleState::Running, std::memory_order_release);
  }
  return true;
}

bool Processes::ready() const noexcept {
  return std::none_of(children_.begin(), children_.end(), [this](const Child& child) {
    return run_.modules()[child.index].state.load(std::memory_order_acquire) == ModuleState::Starting;
  });
}

bool Processes::supervise(rt::MonoTime now, rt::MonoTime schedule, std::int64_t stalled_ns) {
  for (Child& child : children_) {
    scheduler::ModuleRecord& module = record(child);
    if (child.pid > 0) {
      int status = 0;
      if (::waitpid(child.pid, &status, WNOHANG) == child.pid) {
        died(child, status, schedule);
      } else if (child.stopping) {
        kill_if_late(child, now);
      } else if (module.state.load(std::memory_order_acquire) == ModuleState::Starting && enrolled(child)) {
        enter(child);
      } else {
        enforce_budget(child, schedule, stalled_ns);
      }
    } else if (module.state.load(std::memory_order_relaxed) == ModuleState::Restarting && !child.held &&
               schedule >= child.restart_at) {
      module.restarts.fetch_add(1, std::memory_order_relaxed);
      if (!launch(child)) {
        plan_restart(child, schedule);
      }
    }
  }
  return !reason_.empty();
}

// It may be another program than the one whose version was noted.
void Processes::enter(Child& child) {
  if (executes(child.pid, child.program.file, child.program.mark)) {
    record(child).state.store(ModuleState::Running, std::memory_order_release);
  } else if (!std::exchange(child.was_replaced, true)) {
    ::kill(child.pid, SIGKILL);
  }
}

std::optional<rt::MonoTime> Processes::next_restart() const noexcept {
  std::optional<rt::MonoTime> next;
  for (const Child& child : children_) {
    const bool waits = child.pid <= 0 && run_.modules()[child.index].state.load() == ModuleState::Restarting;
    next = waits && (!next || child.restart_at < *next) ? child.restart_at : next;
  }
  return next;
}

void Processes::fault(Child& child, FaultKind kind, const std::string& text) {
  scheduler::ModuleRecord& module = record(child);
  scheduler::record_fault(module, kind, run_.tick.load(std::memory_order_relaxed), text);
  failsafe_.apply(child.index);
}

std::string Processes::describe_start_failure(const Child& child, int status) {
  return describe_end(status) +
         (child.module->signal != 0 ? " before it expected its signal" : " before it called irp::waitPeriod()");
}

void Processes::died(Child& child, int status, rt::MonoTime schedule) {
  scheduler::ModuleRecord& module = record(child);
  if (scheduler::ProcessSlot& at = slot(child); at.runner.load() == child.pid) {
    at.done.store(at.taken.load(), std::memory_order_release);  // another process may follow
  }
  child.pid = -1;
  module.pid.store(0, std::memory_order_release);
  if (child.stopping) {
    return;
  }
  if (std::exchange(child.was_replaced, false)) {
    if (!launch(child)) {
      plan_restart(child, schedule);
    }
    return;
  }
  const bool was_starting = module.state.load(std::memory_order_acquire) == ModuleState::Starting;
  const bool did_not_start = was_starting && WIFEXITED(status);
  if (child.aside) {
    scheduler::record_fault(module, did_not_start ? FaultKind::StartFailed : FaultKind::Exit,
                            run_.tick.load(std::memory_order_relaxed),
                            did_not_start ? describe_start_failure(child, status) : describe_end(status));
    module.state.store(ModuleState::Faulted, std::memory_order_release);
    return;
  }
  if (child.module->operation == Operation::NonReal && WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    module.state.store(ModuleState::Exited, std::memory_order_release);
    return;
  }
  if (tape_ != nullptr) {
    const scheduler::ProcessSlot& at = slot(child);
    tape_->end_of_dead(child.index,
                       {0, 0, at.release_tick.load(), at.release_ns.load(), at.start_ns.load(), rt::to_ns(schedule)});
  }
  module.state.store(ModuleState::Restarting, std::memory_order_release);
  if (child.killed_for_budget) {
    fault(child, FaultKind::Budget,
          fmt::format("killed: one run took longer than its budget of {} us", module.budget_ns / 1000));
  } else if (child.killed_hanging) {
    fault(child, FaultKind::Budget, "killed: one run did not return for 10 s of real time");
  } else if (did_not_start) {
    fault(child, FaultKind::StartFailed, describe_start_failure(child, status));
  } else {
    fault(child, FaultKind::Exit, describe_end(status));
  }
  plan_restart(child, schedule);
}

void Processes::plan_restart(Child& child, rt::MonoTime schedule) {
  const config::Restart& rule = child.module->restart;
  while (!child.restarts.empty() && schedule - child.restarts.front() > rule.window) {
    child.restarts.pop_front();
  }
  scheduler::ModuleRecord& module = record(child);
  if (child.restarts.size() >= rule.max) {
    module.state.store(ModuleState::Faulted, std::memory_order_release);
    if (rule.escalate == config::Restart::Escalate::StopNode) {
      reason_ = fmt::format("process module {} died {} times within {} s (escalate stop-node)", module.name,
                            child.restarts.size() + 1, rule.window.count() / rt::kNanosPerSecond);
    } else {
      console_.about(module.name)
          .error("module {}: stays stopped, it was restarted {} times within {} s", module.name, child.restarts.size(),
                 rule.window.count() / rt::kNanosPerSecond);
    }
    return;
  }
  child.restarts.push_back(schedule);
  if (child.restarts.size() > kRestartsKept) {
    child.restarts.pop_front();
  }
  child.restart_at = schedule + rule.delay;
  module.state.store(ModuleState::Restarting, std::memory_order_release);
}

void Processes::enforce_budget(Child& child, rt::MonoTime schedule, std::int64_t stalled_ns) {
  const std::int64_t stalled = stalled_ns - std::exchange(child.stalled_ns, stalled_ns);
  const scheduler::ModuleRecord& module = record(child);
  const scheduler::ProcessSlot& at = slot(child);
  if (!managed(child) || module.budget_ns <= 0 || child.killed_for_budget) {
    return;
  }
  const std::uint64_t done = at.done.load(std::memory_order_acquire);
  const std::int64_t start = at.start_ns.load(std::memory_order_relaxed);
  const bool running =
      done != at.released.load(std::memory_order_relaxed) && start >= at.release_ns.load(std::memory_order_relaxed);
  if (!running) {
    return;
  }
  const std::int64_t lasts = rt::to_ns(schedule) - start;
  const std::int64_t before = std::exchange(child.run_start_ns, start) == start ? child.excused_ns : 0;
  child.excused_ns = before + std::clamp<std::int64_t>(stalled, 0, std::max<std::int64_t>(lasts, 0));
  if (lasts - child.excused_ns > module.budget_ns) {
    child.killed_for_budget = true;
    ::kill(child.pid, SIGKILL);
  }
}

void Processes::kill_hanging(std::uint32_t module) {
  if (Child* child = find(module); child != nullptr && child->pid > 0 && !child->killed_hanging) {
    child->killed_hanging = true;
    ::kill(child->pid, SIGKILL);
  }
}

void Processes::ask_to_end(Child& child) {
  slot(child).stop.store(1, std::memory_order_release);  // reported to it by waitPeriod() or irp::stop_requested()
  slot(child).wake.wake();
  if (child.module->signal != 0) {
    ::kill(child.pid, SIGTERM);  // it knows nothing of the node
  }
}

void Processes::stop(std::uint32_t module, rt::MonoTime now) {
  if (Child* child = find(module); child != nullptr) {
    record(*child).state.store(ModuleState::Stopped, std::memory_order_release);  // from here on it is not released
    child->stopping = true;
    child->asked = now;
    if (child->pid > 0) {
      ask_to_end(*child);
    }
  }
}

void Processes::kill_if_late(Child& child, rt::MonoTime now) {
  const std::chrono::nanoseconds since = now - child.asked;
  if (since > kProcessGrace) {
    console_.about(record(child).name).warning("module {} did not end within 2 s and was killed", record(child).name);
    ::kill(child.pid, SIGKILL);
    child.asked = now;
  } else if (since > kAsked) {
    ::kill(child.pid, SIGTERM);  // it does not check for a request
  }
}

bool Processes::has_ended(std::uint32_t module) const noexcept {
  return std::none_of(children_.begin(), children_.end(),
                      [module](const Child& child) { return child.index == module && child.pid > 0; });
}

bool Processes::start(std::uint32_t module, bool aside) {
  Child* child = find(module);
  if (child == nullptr) {
    return false;
  }
  child->stopping = false;
  child->restarts.clear();
  child->aside = aside;
  return launch(*child);
}

void Processes::let_run(std::uint32_t module) {
  Child& child = *find(module);
  child.aside = false;
  if (const int priority = record(child).fifo_priority; priority > 0 && child.pid > 0) {
    (void)rt::set_fifo_of(child.pid, priority);
  }
}

void Processes::end_all() {
  for (Child& child : children_) {
    if (child.pid <= 0) {
      continue;
    }
    ask_to_end(child);
  }
  const rt::MonoTime deadline = rt::MonoClock::now() + kProcessGrace;
  for (Child& child : children_) {
    int status = 0;
    bool long_wait_reported = false;
    while (child.pid > 0 && ::waitpid(child.pid, &status, WNOHANG) != child.pid) {
      const rt::MonoTime now = rt::MonoClock::now();
      if (now > deadline) {
        console_.about(record(child).name)
            .warning("module {} did not end within 2 s and was killed", record(child).name);
        ::kill(child.pid, SIGKILL);
        ::waitpid(child.pid, &status, 0);
        break;
      }
      if (!long_wait_reported && now > deadline - kProcessGrace + kAsked) {
        ::kill(child.pid, SIGTERM);  // it does not check for a request
        long_wait_reported = true;
      }
      rt::sleep_until(now + kPoll);
    }
    if (child.pid > 0) {
      child.pid = -1;
      record(child).pid.store(0, std::memory_order_release);
      record(child).state.store(ModuleState::Stopped, std::memory_order_release);
    }
  }
}

}  // namespace indurop::node
