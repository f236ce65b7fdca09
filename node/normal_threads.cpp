// SPDX-License-Identifier: Apache-2.0
#include "node/normal_threads.h"

#include <algorithm>

#include "rt/clock.h"

namespace indurop::node {
namespace {

constexpr std::int64_t kLookNs = 10'000'000;
constexpr std::int64_t kGraceNs = 2'000'000'000;
constexpr std::size_t kStackBytes = 8 * 1024 * 1024;

}  // namespace

struct NormalThreads::Normal {
  Normal(scheduler::RunBlock& run, scheduler::Clock& clock, const scheduler::Hooks& hooks, scheduler::CoreTrace& trace)
      : runner(run, clock, hooks, trace, 1) {}
  scheduler::TaskState state;
  scheduler::Runner runner;
  std::int64_t period_ns = 0;
  std::atomic<bool> done{false};
  rt::Thread thread;
};

NormalThreads::NormalThreads(const deploy::Config& config, scheduler::RunBlock& run,
                             const std::vector<ModuleLibrary>& libraries, const scheduler::Hooks& hooks)
    : config_(config), run_(run), libraries_(libraries), hooks_(hooks) {}

NormalThreads::~NormalThreads() {
  stop();
}

void NormalThreads::start() {
  for (std::uint32_t i = 0; i < config_.modules.size(); ++i) {
    const deploy::Module& module = config_.modules[i];
    if (module.type != scheduler::ModuleType::Thread || module.operation != scheduler::Operation::NonReal) {
      continue;
    }
    auto normal = std::make_unique<Normal>(run_, clock_, hooks_, trace_);
    normal->state.task.index = i;
    normal->state.task.operation = scheduler::Operation::NonReal;
    normal->state.task.run = libraries_[i].functions().run;
    normal->state.record = &run_.modules()[i];
    normal->period_ns = module.period.count();
    auto thread =
        rt::Thread::start({"irp-normal", 0, module.core, kStackBytes}, [this, &normal = *normal] { loop(normal); });
    if (thread) {
      normal->thread = std::move(thread).value();
      normals_.push_back(std::move(normal));
    }
  }
}

void NormalThreads::loop(Normal& normal) noexcept {
  const rt::HandlerStack handler_stack;
  normal.runner.attach_thread();
  scheduler::ModuleRecord& record = *normal.state.record;
  record.state.store(scheduler::ModuleState::Running);
  scheduler::TaskState* const only[] = {&normal.state};
  std::int64_t next = rt::now_ns();
  do {
    normal.runner.run(only, run_.tick.load(std::memory_order_relaxed), rt::now_ns());
    next = std::max(next + normal.period_ns, rt::now_ns());
    while (normal.period_ns > 0 && rt::now_ns() < next && !stop_.load()) {
      rt::sleep_until(std::min(next, rt::now_ns() + kLookNs));
    }
  } while (normal.period_ns > 0 && !stop_.load() && normal.state.enabled.load());
  normal.runner.detach_thread();
  if (normal.state.enabled.load()) {
    record.state.store(scheduler::ModuleState::Exited);
  }
  normal.done.store(true);
}

void NormalThreads::stop() {
  stop_.store(true);
  const std::int64_t give_up = rt::now_ns() + kGraceNs;
  for (const auto& normal : normals_) {
    while (!normal->done.load()) {
      rt::sleep_until(rt::now_ns() + kLookNs);
      if (const std::int64_t now = rt::now_ns(); now > give_up) {
        normal->runner.enforce_budget(now, true, 1);
      }
    }
    normal->thread.join();
  }
  normals_.clear();
}

}  // namespace indurop::node
