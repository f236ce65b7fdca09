// SPDX-License-Identifier: Apache-2.0
#include "node/modules/normal_threads.h"

#include <algorithm>

#include "core/rt/clock.h"

namespace indurop::node {
namespace {

constexpr std::chrono::milliseconds kThreadPoll{10};
constexpr std::chrono::seconds kGrace{2};
constexpr std::size_t kThreadStack = std::size_t{8} * 1024 * 1024;

}  // namespace

struct NormalThreads::Normal {
  enum class Halt : std::uint8_t { None, Requested, Taken };
  // Whether its thread is to end. Once it is, it does.
  bool takes_halt() noexcept {
    Halt requested = Halt::Requested;
    return halt.compare_exchange_strong(requested, Halt::Taken) || requested == Halt::Taken;
  }
  Normal(scheduler::RunBlock& run, scheduler::Kernel& with, const scheduler::Hooks& hooks, scheduler::CoreTrace& trace)
      : runner(run, with, hooks, trace, 1), kernel(with) {}
  scheduler::TaskState state;
  scheduler::Runner runner;
  scheduler::Kernel& kernel;
  std::int64_t period_ns = 0;
  std::atomic<Halt> halt{Halt::None};
  rt::MonoTime give_up;
  std::atomic<bool> done{false};
  std::unique_ptr<scheduler::KernelThread> thread;
};

NormalThreads::NormalThreads(const config::Config& config, scheduler::RunBlock& run,
                             const std::vector<ModuleLibrary>& libraries, const scheduler::Hooks& hooks,
                             scheduler::Kernel& kernel)
    : config_(config), run_(run), libraries_(libraries), hooks_(hooks), kernel_(kernel) {}

NormalThreads::~NormalThreads() {
  stop();
}

void NormalThreads::start() {
  for (std::uint32_t i = 0; i < config_.modules.size(); ++i) {
    const config::Module& module = config_.modules[i];
    if (module.type == scheduler::ModuleType::Thread && module.operation == scheduler::Operation::NonReal) {
      (void)launch(i);
    }
  }
}

bool NormalThreads::launch(std::uint32_t module) {
  const std::int64_t period_ns = config_.modules[module].period.count();
  scheduler::Kernel& kernel = period_ns > 0 ? kernel_ : system_;
  auto normal = std::make_unique<Normal>(run_, kernel, hooks_, trace_);
  normal->state.task.index = module;
  normal->state.task.operation = scheduler::Operation::NonReal;
  normal->state.task.run = libraries_[module].functions().run;
  normal->state.record = &run_.modules()[module];
  normal->period_ns = period_ns;
  auto thread = kernel.start({"irp-normal", 0, config_.modules[module].core, kThreadStack},
                             [this, &normal = *normal] { loop(normal); });
  if (!thread) {
    return false;
  }
  normal->thread = std::move(thread).value();
  normals_.push_back(std::move(normal));
  return true;
}

NormalThreads::Normal* NormalThreads::find(std::uint32_t module) noexcept {
  const auto found = std::find_if(normals_.begin(), normals_.end(),
                                  [module](const auto& normal) { return normal->state.task.index == module; });
  return found == normals_.end() ? nullptr : found->get();
}

void NormalThreads::halt(std::uint32_t module, rt::MonoTime now) {
  if (Normal* normal = find(module); normal != nullptr) {
    normal->give_up = now + kGrace;
    normal->halt.store(Normal::Halt::Requested);
  }
}

bool NormalThreads::has_ended(std::uint32_t module, rt::MonoTime now) {
  Normal* normal = find(module);
  if (normal == nullptr) {
    return true;
  }
  if (!normal->done.load()) {
    if (now > normal->give_up) {
      normal->runner.enforce_budget(now, true, 1);
    }
    return false;
  }
  remove(*normal);
  return true;
}

bool NormalThreads::has_left(std::uint32_t module) {
  Normal* normal = find(module);
  const bool done = normal == nullptr || normal->done.load();
  if (normal != nullptr && done) {
    remove(*normal);
  }
  return done;
}

bool NormalThreads::go_on(std::uint32_t module) noexcept {
  Normal* normal = find(module);
  Normal::Halt requested = Normal::Halt::Requested;
  return normal != nullptr && normal->halt.compare_exchange_strong(requested, Normal::Halt::None);
}

void NormalThreads::remove(Normal& normal) {
  normal.thread->join();
  std::erase_if(normals_, [&normal](const auto& one) { return one.get() == &normal; });
}

void NormalThreads::loop(Normal& normal) noexcept {
  const rt::HandlerStack handler_stack;
  normal.runner.attach_thread();
  scheduler::ModuleRecord& record = *normal.state.record;
  record.state.store(scheduler::ModuleState::Running);
  scheduler::TaskState* const only[] = {&normal.state};
  const auto leaving = [&] { return stop_.load() || normal.takes_halt(); };
  scheduler::Kernel& kernel = normal.kernel;
  rt::MonoTime next = kernel.now();
  do {
    normal.runner.run(only, run_.tick.load(std::memory_order_relaxed), kernel.now());
    next = std::max(next + std::chrono::nanoseconds{normal.period_ns}, kernel.now());
    while (normal.period_ns > 0 && kernel.now() < next && !leaving()) {
      kernel.sleep_until(std::min(next, kernel.now() + kThreadPoll));
    }
  } while (normal.period_ns > 0 && !leaving() && !normal.state.is_closed());
  normal.runner.detach_thread();
  if (!normal.state.is_closed()) {
    record.state.store(scheduler::ModuleState::Exited);
  }
  normal.done.store(true);
}

void NormalThreads::stop() {
  stop_.store(true);
  for (const auto& normal : normals_) {
    scheduler::Kernel& kernel = normal->kernel;
    const rt::MonoTime give_up = kernel.now() + kGrace;
    while (!normal->done.load()) {
      kernel.sleep_until(kernel.now() + kThreadPoll);
      if (const rt::MonoTime now = kernel.now(); now > give_up) {
        normal->runner.enforce_budget(now, true, 1);
      }
    }
    normal->thread->join();
  }
  normals_.clear();
}

}  // namespace indurop::node
