// SPDX-License-Identifier: Apache-2.0
// Functions of <indurop/irp.h> for the life of a process and the schedule.

#include <indurop/irp.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "core/rt/clock.h"
#include "store/runtime/enrolment.h"
#include "store/runtime/host.h"
#include "store/runtime/process.h"

namespace irp {

namespace {

namespace runtime = indurop::runtime;
using indurop::Errc;
using indurop::scheduler::ModuleRecord;
using indurop::scheduler::RunBlock;

int negative(Errc code) noexcept {
  return -static_cast<int>(code);
}

const ModuleRecord* calling_module(const RunBlock* run) noexcept {
  const std::uint32_t index = runtime::current_module();
  return run != nullptr && index < run->module_count ? &run->modules()[index] : nullptr;
}

const RunBlock* current_run() noexcept {
  return runtime::hot.run.load(std::memory_order_acquire);
}

// The run of the node whose thread module calls; null if none does.
RunBlock* own_run() noexcept {
  RunBlock* const run = runtime::hot.run.load(std::memory_order_acquire);
  const bool is_own =
      run != nullptr && runtime::Process::get().hosted() && runtime::current_module() < run->module_count;
  return is_own ? run : nullptr;
}

// For threads that run no run of a module: the basic period that the node is in.
std::uint64_t present_tick(const RunBlock& run) noexcept {
  const std::uint64_t begun = run.tick.load(std::memory_order_acquire);
  return begun > 0 ? begun - 1 : 0;
}

}  // namespace

int initPeriodExe() {
  return negative(runtime::Enrolment::get().begin().error().code);
}

bool waitPeriod() {
  return runtime::Enrolment::get().wait();
}

int attach(const char* node) {
  const std::string name = node == nullptr || *node == '\0' ? runtime::default_node() : node;
  auto& process = runtime::Process::get();
  std::size_t unbound = 0;
  if (const auto status = process.attach(name, unbound); !status) {
    process.report(
        fmt::format("cannot attach to node '{}': {} ({})", name, to_string(status.error().code), status.error().where));
    return negative(status.error().code);
  }
  if (!process.hosted()) {
    (void)process.servers().start(0, -1);
  }
  return unbound > 0 ? negative(Errc::TypeMismatch) : 0;
}

std::chrono::nanoseconds period() noexcept {
  const ModuleRecord* record = calling_module(current_run());
  return std::chrono::nanoseconds(record != nullptr ? record->period_ns.load() : 0);
}

std::uint64_t tick() noexcept {
  const auto& enrolment = runtime::Enrolment::get();
  if (enrolment.enrolled()) {
    return enrolment.release_tick();
  }
  if (const auto* const own = runtime::current_release()) {
    return own->tick;
  }
  const RunBlock* run = current_run();
  return run != nullptr ? present_tick(*run) : 0;
}

std::int64_t release_ns() noexcept {
  const auto& enrolment = runtime::Enrolment::get();
  if (enrolment.enrolled()) {
    return enrolment.release_ns();
  }
  if (const auto* const own = runtime::current_release()) {
    return own->release_ns;
  }
  const RunBlock* run = current_run();
  return run != nullptr ? run->epoch_ns + static_cast<std::int64_t>(present_tick(*run)) * run->basic_period_ns : 0;
}

void shift_ticks(std::chrono::nanoseconds by) noexcept {
  constexpr std::int64_t kShare = 100;
  if (RunBlock* const run = own_run()) {
    const std::int64_t most = run->basic_period_ns / kShare;
    run->epoch_ns.fetch_add(std::clamp(by.count(), -most, most), std::memory_order_relaxed);
  }
}

void report_pulse(std::chrono::nanoseconds after, std::chrono::nanoseconds wanted) noexcept {
  if (RunBlock* const run = own_run()) {
    run->pulse_after_ns.store(after.count(), std::memory_order_relaxed);
    run->pulse_wanted_ns.store(wanted.count(), std::memory_order_relaxed);
  }
}

std::int64_t now_ns() noexcept {
  return runtime::read_clock();
}

std::int64_t learned(std::int64_t what) noexcept {
  return runtime::answer([what] { return what; });
}

bool stop_requested() noexcept {
  return runtime::answer([]() -> std::int64_t { return runtime::Enrolment::get().stop_requested() ? 1 : 0; }) != 0;
}

}  // namespace irp
