// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/host.h"

#include <indurop/detail/abi.h>

#include <limits>

#include "store/runtime/process.h"

namespace indurop::runtime {

namespace {

// Initial-exec: at a fixed address, never allocated at first use.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): which module a thread runs
[[gnu::tls_model("initial-exec")]] thread_local std::uint32_t t_module = kNoModule;

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): likewise
[[gnu::tls_model("initial-exec")]] thread_local OwnRelease t_release;
[[gnu::tls_model("initial-exec")]] thread_local bool t_in_run = false;
[[gnu::tls_model("initial-exec")]] thread_local tape::Track* t_track = nullptr;
[[gnu::tls_model("initial-exec")]] thread_local const std::int64_t* t_reading = nullptr;
[[gnu::tls_model("initial-exec")]] thread_local const std::int64_t* t_readings_end = nullptr;
[[gnu::tls_model("initial-exec")]] thread_local const tape::ReplayedAnswer* t_answer = nullptr;
[[gnu::tls_model("initial-exec")]] thread_local const tape::ReplayedAnswer* t_answers_end = nullptr;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

}  // namespace

void set_current_track(tape::Track* track) noexcept {
  t_track = track;
}

void set_clock_readings(std::span<const std::int64_t> readings) noexcept {
  t_reading = readings.data();
  t_readings_end = readings.data() + readings.size();
}

std::int64_t read_clock() noexcept {
  if (t_reading != t_readings_end) {
    return *t_reading++;
  }
  const std::int64_t now = rt::to_ns(schedule_now());
  if (t_track != nullptr) {
    t_track->clock(now);
  }
  return now;
}

void set_answers(std::span<const tape::ReplayedAnswer> answers) noexcept {
  t_answer = answers.data();
  t_answers_end = answers.data() + answers.size();
}

const tape::ReplayedAnswer* next_answer() noexcept {
  return t_answer != t_answers_end ? t_answer++ : nullptr;
}

void note_answer(std::int64_t code, const void* bytes, std::size_t size) noexcept {
  if (t_track != nullptr) {
    t_track->record_answer(code, {static_cast<const std::uint8_t*>(bytes), size});
  }
}

std::int64_t see_confirmed(std::int64_t confirmed) noexcept {
  // As a code, the lowest number has another meaning.
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  const std::int64_t code = answer([confirmed] { return confirmed == abi::kNeverConfirmed ? kNever : confirmed; });
  return code == kNever ? abi::kNeverConfirmed : code;
}

void set_current_module(std::uint32_t index) noexcept {
  t_module = index;
  t_in_run = false;
}

void set_current_run(std::uint32_t index, OwnRelease release) noexcept {
  t_module = index;
  t_release = release;
  t_in_run = true;
}

const OwnRelease* current_release() noexcept {
  return t_in_run ? &t_release : nullptr;
}

std::uint32_t current_module() noexcept {
  return t_module != kNoModule ? t_module : hot.process_module.load(std::memory_order_relaxed);
}

std::string schema_text() {
  const Attachment* attachment = hot.attachment.load(std::memory_order_acquire);
  return attachment != nullptr ? schema::to_json(attachment->store().schema()) : std::string{};
}

std::string config_file() {
  const scheduler::RunBlock* run = hot.run.load(std::memory_order_acquire);
  return run != nullptr ? std::string(run->config_file) : std::string{};
}

std::optional<std::int64_t> virtual_ns() noexcept {
  const scheduler::RunBlock* run = hot.run.load(std::memory_order_acquire);
  const std::int64_t now = run != nullptr ? run->virtual_ns.load(std::memory_order_relaxed) : 0;
  return now != 0 ? std::optional(now) : std::nullopt;
}

std::vector<std::string> attach_process(vars::Store& store, scheduler::RunBlock& run) {
  return Process::get().host(store, run);
}

void detach_process() {
  Process::get().unhost();
}

void release_chunks_of(std::uint32_t module) noexcept {
  Process::get().release_chunks_of(module);
}

std::vector<std::string> take_binding_errors() {
  return Process::get().take_errors();
}

void bind_apart(const void* inside) {
  Process::get().bind_apart(inside);
}

void bind_back(const void* inside) {
  Process::get().bind_back(inside);
}

Status start_function_servers(int fifo_priority, int core) {
  return Process::get().servers().start(fifo_priority, core);
}

void stop_function_servers() {
  Process::get().servers().stop();
}

}  // namespace indurop::runtime
