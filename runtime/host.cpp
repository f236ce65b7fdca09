// SPDX-License-Identifier: Apache-2.0

#include "runtime/host.h"

#include "runtime/process.h"

namespace indurop::runtime {

namespace {

// Initial-exec: found at a fixed place, never allocated at first use.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): which module a thread runs
[[gnu::tls_model("initial-exec")]] thread_local std::uint32_t t_module = kNoModule;

}  // namespace

void set_current_module(std::uint32_t index) noexcept {
  t_module = index;
}

std::uint32_t current_module() noexcept {
  return t_module != kNoModule ? t_module : hot.process_module.load(std::memory_order_relaxed);
}

std::vector<std::string> attach_process(vars::Store& store, scheduler::RunBlock& run) {
  return Process::get().host(store, run);
}

void detach_process() {
  Process::get().unhost();
}

std::vector<std::string> take_binding_errors() {
  return Process::get().take_errors();
}

Status start_function_servers(int fifo_priority, int core) {
  return Process::get().servers().start(fifo_priority, core);
}

void stop_function_servers() {
  Process::get().servers().stop();
}

}  // namespace indurop::runtime
