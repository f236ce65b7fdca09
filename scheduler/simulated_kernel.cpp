// SPDX-License-Identifier: Apache-2.0
#include "scheduler/simulated_kernel.h"

#include <algorithm>
#include <csignal>
#include <thread>
#include <utility>

#include "core/rt/relax.h"
#include "core/rt/relaxed.h"

namespace indurop::scheduler {
namespace {

using rt::kRelaxed;
constexpr int kAnyCore = -1;
constexpr int kPollsBeforeSleep = 2000;          // polls of a running process: some 20 us
constexpr std::chrono::microseconds kPause{50};  // between two polls after that
constexpr std::size_t kLeastStack = std::size_t{256} * 1024;

enum class State {
  Ready,     // has code to run
  Working,   // its code has run, the time for it has not passed yet
  Sleeping,  // until a time
  Waiting,   // for a wake-up
  Ended,
};

}  // namespace

struct SimulatedKernel::Thread {
  Thread(const rt::ThreadSettings& with, std::function<void()> body)
      : settings(with), fiber(std::max(with.stack_bytes, kLeastStack), std::move(body)) {}
  rt::ThreadSettings settings;
  rt::Fiber fiber;
  State state = State::Ready;
  std::uint64_t ready_since = 0;   // place among those of the same priority
  std::int64_t until_ns = 0;       // Sleeping; Waiting: latest time
  std::int64_t left_ns = 0;        // Working
  rt::SignalWord* word = nullptr;  // Waiting
};

// The simulated thread that represents a process module: it makes the process run when it is scheduled.
struct SimulatedKernel::Process {
  Task task;
  ProcessSlot& slot;
  ModuleRecord& record;
  rt::SignalWord woken{};
};

class SimulatedKernel::Handle final : public KernelThread {
 public:
  Handle(SimulatedKernel& kernel, Thread& thread) noexcept : kernel_(kernel), thread_(thread) {}
  ~Handle() override { Handle::join(); }
  void join() noexcept override { kernel_.join(thread_); }

 private:
  SimulatedKernel& kernel_;
  Thread& thread_;
};

SimulatedKernel::SimulatedKernel(rt::MonoTime begin, std::vector<std::atomic<std::int64_t>*> shown, ProcessWatch watch)
    : now_ns_(rt::to_ns(begin)), shown_(std::move(shown)), watch_(std::move(watch)) {
  set_time(rt::to_ns(begin));
}

SimulatedKernel::~SimulatedKernel() = default;

void SimulatedKernel::set_time(std::int64_t ns) noexcept {
  now_ns_.store(ns, kRelaxed);
  for (std::atomic<std::int64_t>* shown : shown_) {
    shown->store(ns, kRelaxed);
  }
}

SimulatedKernel::Thread* SimulatedKernel::start_thread(const rt::ThreadSettings& settings, std::function<void()> body) {
  auto thread = std::make_unique<Thread>(settings, std::move(body));
  if (!thread->fiber.ok()) {
    return nullptr;
  }
  thread->ready_since = ++became_ready_;
  if (std::find(cores_.begin(), cores_.end(), settings.core) == cores_.end()) {
    cores_.push_back(settings.core);
  }
  threads_.push_back(std::move(thread));
  return threads_.back().get();
}

Result<std::unique_ptr<KernelThread>> SimulatedKernel::start(const rt::ThreadSettings& settings,
                                                             std::function<void()> body) {
  Thread* thread = start_thread(settings, std::move(body));
  if (thread == nullptr) {
    return Error{Errc::NoSpace, 0, "create the stack of a simulated thread"};
  }
  return std::unique_ptr<KernelThread>(std::make_unique<Handle>(*this, *thread));
}

void SimulatedKernel::sleep_until(rt::MonoTime deadline) noexcept {
  if (running_ == nullptr) {
    pass_time(deadline);
    return;
  }
  if (deadline > now()) {
    running_->state = State::Sleeping;
    running_->until_ns = rt::to_ns(deadline);
    rt::Fiber::pause();
  }
}

void SimulatedKernel::wait(rt::SignalWord& word) noexcept {
  (void)wait_until(word, kNever);
}

bool SimulatedKernel::wait_until(rt::SignalWord& word, rt::MonoTime deadline) noexcept {
  if (word.try_wait()) {
    return true;
  }
  if (deadline <= now()) {
    return false;
  }
  running_->state = State::Waiting;
  running_->until_ns = rt::to_ns(deadline);
  running_->word = &word;
  rt::Fiber::pause();
  return running_->word == nullptr;
}

void SimulatedKernel::work(std::int64_t ns) noexcept {
  if (ns > 0 && running_ != nullptr) {
    running_->state = State::Working;
    running_->left_ns = ns;
    rt::Fiber::pause();
  }
}

void SimulatedKernel::take_wake_ups() noexcept {
  for (const auto& thread : threads_) {
    if (thread->state == State::Waiting && thread->word->try_wait()) {
      thread->word = nullptr;  // it was woken before its time
      thread->state = State::Ready;
      thread->ready_since = ++became_ready_;
    }
  }
}

// Returns the first of the highest priority among a core's threads that are ready or working.
const SimulatedKernel::Thread* SimulatedKernel::top_of(int core) const noexcept {
  const Thread* top = nullptr;
  for (const auto& thread : threads_) {
    if (thread->settings.core != core || (thread->state != State::Ready && thread->state != State::Working)) {
      continue;
    }
    if (top == nullptr || thread->settings.fifo_priority > top->settings.fifo_priority ||
        (thread->settings.fifo_priority == top->settings.fifo_priority && thread->ready_since < top->ready_since)) {
      top = thread.get();
    }
  }
  return top;
}

SimulatedKernel::Thread* SimulatedKernel::next_to_run() const noexcept {
  for (const int core : cores_) {
    if (core != kAnyCore) {
      if (const Thread* top = top_of(core); top != nullptr && top->state == State::Ready) {
        return const_cast<Thread*>(top);  // NOLINT(cppcoreguidelines-pro-type-const-cast): ours
      }
    }
  }
  // There is always a core for threads without a fixed core, after the others.
  const auto any = std::find_if(threads_.begin(), threads_.end(), [](const auto& thread) {
    return thread->settings.core == kAnyCore && thread->state == State::Ready;
  });
  return any == threads_.end() ? nullptr : any->get();
}

void SimulatedKernel::run_until_quiet() noexcept {
  for (;;) {
    take_wake_ups();
    Thread* const next = next_to_run();
    if (next == nullptr) {
      return;
    }
    run(*next);
  }
}

void SimulatedKernel::run(Thread& thread) noexcept {
  thread.state = State::Ready;
  running_ = &thread;
  resumptions_.fetch_add(1, kRelaxed);
  thread.fiber.resume();
  running_ = nullptr;
  if (thread.fiber.ended()) {
    thread.state = State::Ended;
  }
}

// Returns true if the work of a thread progresses: no thread of a higher priority occupies its core.
bool SimulatedKernel::at_work(const Thread& thread) const noexcept {
  return thread.state == State::Working &&
         (thread.settings.core == kAnyCore || top_of(thread.settings.core) == &thread);
}

rt::MonoTime SimulatedKernel::next_event() const noexcept {
  std::int64_t next = INT64_MAX;
  for (const auto& thread : threads_) {
    if (thread->state == State::Sleeping || thread->state == State::Waiting) {
      next = std::min(next, thread->until_ns);
    } else if (at_work(*thread)) {
      next = std::min(next, now_ns_.load(kRelaxed) + thread->left_ns);
    }
  }
  return rt::mono_time(next);
}

void SimulatedKernel::pass_time(rt::MonoTime until) noexcept {
  run_until_quiet();
  while (now() < until) {
    const std::int64_t next = std::min(rt::to_ns(next_event()), rt::to_ns(until));
    const std::int64_t passed = next - now_ns_.load(kRelaxed);
    working_.clear();
    for (const auto& thread : threads_) {
      if (at_work(*thread)) {
        working_.push_back(thread.get());
      }
    }
    set_time(next);
    // Work that ends now ends before other work begins: a run that takes exactly its maximum time is no overrun.
    for (Thread* thread : working_) {
      thread->left_ns -= passed;
      if (thread->left_ns == 0) {
        run(*thread);
      }
    }
    for (const auto& thread : threads_) {
      const bool waits = thread->state == State::Sleeping || thread->state == State::Waiting;
      if (waits && thread->until_ns <= next) {
        thread->state = State::Ready;
        thread->ready_since = ++became_ready_;
      }
    }
    run_until_quiet();
  }
}

void SimulatedKernel::join(Thread& thread) noexcept {
  run_until_quiet();
  while (thread.state != State::Ended && next_event() != kNever) {
    pass_time(next_event());
  }
}

SimulatedKernel::Process& SimulatedKernel::process_of(const Task& task, ProcessSlot& slot, ModuleRecord& record) {
  auto& process = processes_[&slot];
  if (process == nullptr) {
    process = std::make_unique<Process>(Process{task, slot, record});
    process->woken.init(false);
    (void)start_thread({"process", record.fifo_priority, record.core}, [this, &one = *process] {
      for (;;) {
        wait(one.woken);
        one.task.legacy_signal != 0 ? run_signalled(one) : run_process(one);
      }
    });
  }
  return *process;
}

void SimulatedKernel::wake_process(const Task& task, ProcessSlot& slot, ModuleRecord& record) noexcept {
  process_of(task, slot, record).woken.wake();
}

void SimulatedKernel::run_process(Process& process) noexcept {
  ProcessSlot& slot = process.slot;
  const std::uint64_t release = slot.released.load(kRelaxed);
  slot.wake.wake();
  int idle_polls = 0;
  const rt::MonoTime began = rt::MonoClock::now();
  while (slot.done.load(std::memory_order_acquire) != release) {
    if (++idle_polls < kPollsBeforeSleep) {
      rt::relax();
      continue;
    }
    std::this_thread::sleep_for(kPause);
    if (!watch_.patient(process.record, rt::MonoClock::now() - began)) {
      return;
    }
  }
  if (process.task.work_ns > 0) {
    // The process is done and waits; for the schedule it is not done until its time has passed.
    slot.done.store(release - 1, std::memory_order_release);
    work(process.task.work_ns);
    slot.end_ns.store(now_ns_.load(kRelaxed), kRelaxed);
    slot.done.store(release, std::memory_order_release);
  }
}

void SimulatedKernel::run_signalled(Process& process) noexcept {
  const pid_t pid = process.record.pid.load(kRelaxed);
  const rt::MonoTime began = rt::MonoClock::now();
  ::kill(pid, process.task.legacy_signal);
  do {
    std::this_thread::sleep_for(kPause);
  } while (watch_.patient(process.record, rt::MonoClock::now() - began) &&
           !watch_.at_rest(pid, process.task.legacy_signal));
  work(process.task.work_ns);
}

}  // namespace indurop::scheduler
