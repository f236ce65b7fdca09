// SPDX-License-Identifier: Apache-2.0
#include "scheduler/kernel.h"

#include <csignal>
#include <utility>

namespace indurop::scheduler {
namespace {

class SystemThread final : public KernelThread {
 public:
  explicit SystemThread(rt::Thread thread) noexcept : thread_(std::move(thread)) {}
  void join() noexcept override { thread_.join(); }

 private:
  rt::Thread thread_;
};

}  // namespace

void Kernel::wait(rt::SignalWord& word) noexcept {
  word.wait();
}

void Kernel::wake_process(const Task& task, ProcessSlot& slot, ModuleRecord& record) noexcept {
  if (task.legacy_signal != 0) {
    ::kill(record.pid.load(std::memory_order_relaxed), task.legacy_signal);
  } else {
    slot.wake.wake();
  }
}

void Kernel::work(std::int64_t /*ns*/) noexcept {}

Result<std::unique_ptr<KernelThread>> Kernel::start(const rt::ThreadSettings& settings, std::function<void()> body) {
  auto thread = rt::Thread::start(settings, std::move(body));
  if (!thread) {
    return thread.error();
  }
  return std::unique_ptr<KernelThread>(std::make_unique<SystemThread>(std::move(thread).value()));
}

rt::MonoTime SystemKernel::now() noexcept {
  return rt::MonoClock::now();
}
void SystemKernel::sleep_until(rt::MonoTime deadline) noexcept {
  rt::sleep_until(deadline);
}

}  // namespace indurop::scheduler
