// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/enrolment.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/base/exit_code.h"
#include "core/rt/clock.h"
#include "core/rt/lost_pages.h"
#include "core/rt/machine.h"
#include "core/rt/thread.h"
#include "store/runtime/host.h"
#include "store/runtime/process.h"

namespace indurop::runtime {

namespace {

using scheduler::ModuleRecord;
using scheduler::ModuleType;
using scheduler::NodeState;
using scheduler::RunBlock;

constexpr unsigned kIdlesPerFullCheck = 10;

// The memory of this process's node was lost; the process ends too. Called in a signal handler.
void end_without_memory(void* /*context*/, const char* file) {
  constexpr std::string_view kSaid = ": a process truncated this shared memory of the node; this program ends\n";
  (void)!::write(STDERR_FILENO, "indurop: error: ", 16);
  (void)!::write(STDERR_FILENO, file, std::strlen(file));
  (void)!::write(STDERR_FILENO, kSaid.data(), kSaid.size());
  ::_exit(kFailed);
}

bool process_exists(std::int32_t pid) noexcept {
  return pid > 0 && (::kill(pid, 0) == 0 || errno == EPERM);
}

// A process may run before the node that launches it knows its id.
std::int32_t successor_of(const RunMapping& mapping, const scheduler::ProcessSlot& slot) {
  constexpr std::int64_t kPollNs = 1'000'000;
  std::int32_t successor = slot.successor.load(std::memory_order_acquire);
  while (successor == scheduler::kBeingLaunched && mapping.node_alive()) {
    rt::sleep_until(rt::now_ns() + kPollNs);
    successor = slot.successor.load(std::memory_order_acquire);
  }
  return successor;
}

std::string_view text_of(const char* text, std::size_t size) {
  return {text, strnlen(text, size)};
}

// Returns the module that this process is: as set by the node, else the process module with the same file.
std::uint32_t find_module(const RunBlock& run) {
  const std::uint32_t assigned = hot.process_module.load(std::memory_order_relaxed);
  if (assigned < run.module_count && run.modules()[assigned].type == ModuleType::Process) {
    return assigned;
  }
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  for (std::uint32_t i = 0; i < run.module_count && !error; ++i) {
    const ModuleRecord& record = run.modules()[i];
    std::error_code different;
    if (record.type == ModuleType::Process &&
        std::filesystem::equivalent(text_of(record.file, sizeof record.file), self, different)) {
      return i;
    }
  }
  return kNoModule;
}

int exit_code_of(Errc code) noexcept {
  return code == Errc::TypeMismatch || code == Errc::VersionMismatch ? kSchemaMismatch : EXIT_FAILURE;
}

// With a limit on locked memory, locking future memory would make later allocations fail.
bool may_lock_everything() noexcept {
  rlimit limit{};
  return ::geteuid() == 0 || (::getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY);
}

}  // namespace

Enrolment& Enrolment::get() {
  static auto* enrolment = new Enrolment;  // NOLINT: used until the very end of the process
  return *enrolment;
}

Status Enrolment::begin() {
  node_ = default_node();
  pid_ = ::getpid();
  const Outcome outcome = enrol(Again::No);
  if (outcome.code == Errc::Ok) {
    return {};
  }
  std::fprintf(stderr, "indurop: initPeriodExe: %s\n", outcome.text.c_str());
  if (outcome.code != Errc::NotFound) {
    end_wanted_ = true;
    exit_code_ = exit_code_of(outcome.code);
  }
  phase_ = Phase::NoNode;
  return Error{outcome.code, 0, "enrol with a node"};
}

Enrolment::Outcome Enrolment::enrol(Again again) {
  if (!vars::valid_node_name(node_)) {
    return {Errc::InvalidArgument,
            fmt::format("INDUROP_NODE is '{}', which is not a valid node name ([A-Za-z0-9_-], at most 40)", node_)};
  }
  rt::on_lost_page(&end_without_memory, nullptr);
  auto mapping = RunMapping::open(node_);
  if (!mapping) {
    const Errc code = mapping.error().code;
    if (code == Errc::NotFound || code == Errc::Busy) {
      return {Errc::NotFound,
              fmt::format("node '{}' is not running; start it with: indurop run module.xml --node {}", node_, node_)};
    }
    return {code, fmt::format("cannot use node '{}': {} ({})", node_, to_string(code), mapping.error().where)};
  }
  if (!mapping->node_alive() || is_ending(mapping->block())) {
    return {
        Errc::NotFound,
        fmt::format("node '{}' is no longer running; start it with: indurop run module.xml --node {}", node_, node_)};
  }
  if (again == Again::Yes && mapping->block().state.load(std::memory_order_acquire) != NodeState::Running) {
    return {Errc::NotFound, {}};  // it is still starting: wait for whether it starts its own process for this module
  }
  std::size_t unbound = 0;
  if (const Status status = Process::get().attach(node_, unbound); !status) {
    return {status.error().code, fmt::format("cannot use the variables of node '{}': {} ({})", node_,
                                             to_string(status.error().code), status.error().where)};
  }
  if (unbound > 0) {
    return {Errc::TypeMismatch, fmt::format("this program does not fit node '{}', see above", node_)};
  }
  return take_slot(*Process::get().adopt_run(std::move(mapping).value()), again);
}

Enrolment::Outcome Enrolment::take_slot(RunMapping& mapping, Again again) {
  RunBlock& run = mapping.block();
  const std::uint32_t index = find_module(run);
  if (index == kNoModule) {
    return {Errc::NotFound, fmt::format("node '{}' has no process module for this program: name it in {} with "
                                        "<moduletype>process</moduletype>",
                                        node_, text_of(run.config_file, sizeof run.config_file))};
  }
  ModuleRecord& record = run.modules()[index];
  auto& slot = run.process_slots()[index];
  const std::int32_t launched = record.pid.load(std::memory_order_acquire);
  const std::int32_t successor = successor_of(mapping, slot);
  const auto is_this = [this](std::int32_t pid) { return pid > 0 && (pid == pid_ || pid == ::getppid()); };
  const bool follows = is_this(successor);
  const bool is_launched = follows || is_this(launched);
  const std::int32_t holder = slot.pid.load(std::memory_order_acquire);
  if (!is_launched) {
    const bool theirs = again == Again::Yes && launched > 0 && process_exists(launched);
    if (theirs || (holder != pid_ && process_exists(holder))) {
      return {Errc::Busy, fmt::format("module '{}' of node '{}' is process {}, which is running; this one ends",
                                      text_of(record.name, sizeof record.name), node_, theirs ? launched : holder)};
    }
  }
  hot.process_module.store(index, std::memory_order_relaxed);
  if (run.virtual_ns.load(std::memory_order_relaxed) == 0) {
    if (!follows) {
      take_priority(record);  // a successor prepares itself without it, so that it delays nothing that runs
    }
    lock_memory(run, record);
  }
  mapping_ = &mapping;
  slot_ = &slot;
  replay_input_.reset();
  if (auto replay_input = tape::ReplayInputReader::open(node_, run.node_pid.load(std::memory_order_relaxed))) {
    replay_input_ = std::move(replay_input).value();
  }
  holder_ = holder;
  enrolled_as_ = follows ? successor : is_launched ? launched : pid_;  // a script may run between the node and it
  phase_ = follows ? Phase::Turn : Phase::Prepared;
  close_records();
  tape_.reset();
  kept_ = KeptThread::prepare(node_, index, run);
  open_tape();
  if (!follows) {
    if (tape_) {
      tape_->track().go_on(slot.version.load(), tape_->track().runs() > 0 ? tape::kRestarted : 0U);
    }
    start_keyframes();
  }
  (void)Process::get().servers().start(record.fifo_priority, record.core);
  return {};
}

// From now on the node releases this process: only once it waits, so that its own preparations are no overruns.
void Enrolment::publish() {
  // Discards releases that an earlier process of this module left unfinished.
  seen_ = slot_->released.load(std::memory_order_acquire);
  slot_->taken.store(seen_, std::memory_order_relaxed);
  slot_->done.store(seen_, std::memory_order_release);
  slot_->obtained_fifo.store(rt::fifo_priority(), std::memory_order_relaxed);
  running_ = false;
  idle_ = 0;
  phase_ = Phase::Enrolled;
  if (!slot_->pid.compare_exchange_strong(holder_, enrolled_as_, std::memory_order_acq_rel)) {
    std::fprintf(stderr,
                 "indurop: waitPeriod: process %d was just enrolled for this module of node '%s'; this one ends\n",
                 holder_, node_.c_str());
    end_wanted_ = true;
  }
}

void Enrolment::take_priority(const ModuleRecord& record) {
  if (record.core >= 0) {
    (void)rt::pin_to_core(record.core);
  }
  if (record.fifo_priority == 0 || !rt::set_fifo(record.fifo_priority)) {
    rt::request_exact_timers();
  }
}

// One that another schedule adds gets its priority later.
void Enrolment::lock_memory(const RunBlock& run, const ModuleRecord& record) {
  const bool is_scheduled = record.operation != scheduler::Operation::NonReal;
  if (is_scheduled && run.obtained.fifo != 0 && may_lock_everything()) {
    (void)rt::lock_memory();
  }
}

void Enrolment::finish_run() noexcept {
  if (running_) {
    running_ = false;
    const std::int64_t end = rt::to_ns(schedule_now());
    slot_->end_ns.store(end, std::memory_order_relaxed);
    if (tape_) {
      tape_->track().end(
          {0, 0, release_tick_.load(std::memory_order_relaxed), release_ns_.load(std::memory_order_relaxed),
           slot_->start_ns.load(std::memory_order_relaxed), end},
          0);
    }
    if (kept_) {
      kept_->leave();
    }
    slot_->done.store(seen_, std::memory_order_release);
  }
}

bool Enrolment::take_release() noexcept {
  if (slot_->released.load(std::memory_order_acquire) <= seen_ ||
      slot_->pid.load(std::memory_order_seq_cst) != enrolled_as_) {
    return false;
  }
  if (!slot_->taken.compare_exchange_strong(seen_, seen_ + 1, std::memory_order_seq_cst)) {
    return false;  // the process that was followed has taken it
  }
  slot_->runner.store(enrolled_as_, std::memory_order_release);
  if (kept_) {
    kept_->enter();
  }
  if (tape_) {
    tape_->track().begin();
    set_current_track(&tape_->track());
  }
  if (replay_input_) {
    set_clock_readings(replay_input_->readings());
    set_answers(replay_input_->answers());
  }
  slot_->start_ns.store(rt::to_ns(schedule_now()), std::memory_order_relaxed);
  ++seen_;
  running_ = true;
  idle_ = 0;
  release_tick_.store(slot_->release_tick.load(std::memory_order_relaxed), std::memory_order_relaxed);
  release_ns_.store(slot_->release_ns.load(std::memory_order_relaxed), std::memory_order_relaxed);
  return true;
}

bool Enrolment::wait() {
  if (phase_ == Phase::Ending) {
    std::exit(EXIT_SUCCESS);  // NOLINT(concurrency-mt-unsafe): the module ignored that it should end
  }
  if (phase_ == Phase::None) {
    (void)begin();
  }
  if (phase_ == Phase::Enrolled) {
    finish_run();
  }
  for (;;) {
    if (phase_ == Phase::Prepared && !end_wanted_) {
      publish();
    }
    if (end_wanted_) {
      if (exit_code_ != EXIT_SUCCESS) {
        std::exit(exit_code_);  // NOLINT(concurrency-mt-unsafe): its parent process must see that it did not run
      }
      phase_ = Phase::Ending;
      return false;
    }
    if (phase_ == Phase::NoNode) {
      rt::sleep_until(rt::now_ns() + kIdleNs);
      try_again();
      continue;
    }
    if (slot_->stop.load(std::memory_order_acquire) != 0) {
      end_wanted_ = true;
    } else if (phase_ == Phase::Turn) {
      wait_for_turn();
    } else if (slot_->pid.load(std::memory_order_acquire) != enrolled_as_) {
      give_way();
    } else if (has_run_last()) {
      pass_on();
    } else if (take_release()) {
      (void)slot_->wake.try_wait();  // this release's own wake-up, if it did not wake this process
      Process::get().refresh();
      return true;
    } else if (slot_->wake.wait_until(rt::mono_time(rt::now_ns() + kIdleNs))) {
      if (!has_run_last() && take_release()) {
        Process::get().refresh();
        return true;
      }
    } else {
      check_node();
    }
  }
}

void Enrolment::check_node() {
  ++idle_;
  Process::get().refresh();
  const std::int32_t node_pid = mapping_->block().node_pid.load(std::memory_order_acquire);
  const bool alive = idle_ % kIdlesPerFullCheck == 0 ? mapping_->node_alive() : process_exists(node_pid);
  if (!alive) {
    std::fprintf(stderr, "indurop: node '%s' has ended; waiting for it to start again\n", node_.c_str());
    phase_ = Phase::NoNode;
  }
}

void Enrolment::try_again() {
  const Outcome outcome = enrol(Again::Yes);
  if (outcome.code == Errc::Ok || outcome.code == Errc::NotFound) {
    return;
  }
  std::fprintf(stderr, "indurop: waitPeriod: %s\n", outcome.text.c_str());
  end_wanted_ = true;
  // Another process of this module is not an error.
  exit_code_ = outcome.code == Errc::Busy ? EXIT_SUCCESS : exit_code_of(outcome.code);
}

bool Enrolment::stop_requested() noexcept {
  const RunBlock* run = hot.run.load(std::memory_order_acquire);
  if (run == nullptr) {
    return false;
  }
  const std::uint32_t index = current_module();
  if (is_ending(*run) ||
      (index < run->module_count && run->process_slots()[index].stop.load(std::memory_order_acquire) != 0)) {
    return true;
  }
  if (Process::get().hosted()) {
    return false;
  }
  // A killed node cannot ask for anything; the next one starts its own processes.
  const std::int64_t now = rt::now_ns();
  if (now < next_check_ns_.load(std::memory_order_relaxed)) {
    return false;
  }
  next_check_ns_.store(now + kIdleNs, std::memory_order_relaxed);
  Process::get().refresh();
  return !process_exists(run->node_pid.load(std::memory_order_acquire));
}

}  // namespace indurop::runtime
