// SPDX-License-Identifier: Apache-2.0
// Two processes of one module, while the node exchanges the one for the other: both wait in irp::waitPeriod(), and one
// of them is released. Each release is taken by one process only, so the one that is followed finishes its run, and no
// release is lost.

#include <algorithm>
#include <cstdio>
#include <utility>

#include "core/base/exit_code.h"
#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "store/runtime/enrolment.h"
#include "store/runtime/host.h"
#include "store/runtime/process.h"
#include "store/vars/process.h"

namespace indurop::runtime {

namespace {

using tape::HandOver;

constexpr std::int64_t kLastRunPollNs = 20'000;

}  // namespace

void Enrolment::open_tape() {
  const Attachment* const attachment = hot.attachment.load(std::memory_order_acquire);
  if (attachment == nullptr) {
    return;
  }
  const std::uint32_t module = hot.process_module.load(std::memory_order_relaxed);
  if (auto member = tape::Member::open(node_, module, attachment->store())) {
    tape_ = std::move(member).value();
    if (tape_->has_later_variables()) {
      tape_->add_later(Process::get().uses_of(attachment->store()), attachment->store());
    }
  }
}

// This process's keyframes are those of the module from now on.
void Enrolment::start_keyframes() {
  const std::uint32_t module = hot.process_module.load(std::memory_order_relaxed);
  if (kept_ && !kept_->start(node_, module, tape_ ? &tape_->track() : nullptr)) {
    kept_.reset();
  }
  if (!kept_) {
    tape::ProcessKeyframes::remove(node_, module, tape::ProcessKeyframes::Of::Running);
  }
}

void Enrolment::close_records() {
  set_current_track(nullptr);
  kept_.reset();
}

void Enrolment::wait_for_turn() {
  const auto is_this = [this](const std::atomic<std::int32_t>& pid) {
    return pid.load(std::memory_order_acquire) == enrolled_as_;
  };
  const scheduler::RunBlock& run = mapping_->block();
  const rt::MonoTime idle = rt::mono_time(rt::now_ns() + kIdleNs);
  if (is_this(slot_->may_follow)) {
    if (run.virtual_ns.load(std::memory_order_relaxed) == 0) {
      take_priority(run.modules()[hot.process_module.load(std::memory_order_relaxed)]);
    }
    const std::uint64_t from = slot_->follow_from.load(std::memory_order_relaxed);
    if (is_this(slot_->pid) || run.tick.load(std::memory_order_acquire) >= from) {
      follow();
    } else {
      const std::int64_t from_ns = run.epoch_ns.load() + static_cast<std::int64_t>(from) * run.basic_period_ns;
      (void)slot_->turn.wait_until(std::min(idle, rt::mono_time(from_ns)));
    }
  } else if (mapping_->node_alive() && is_this(slot_->successor)) {
    slot_->ready.store(enrolled_as_, std::memory_order_release);
    (void)slot_->turn.wait_until(idle);
  } else if (mapping_->node_alive() && is_this(slot_->previous)) {
    (void)slot_->recall.wait_until(idle);
  } else {
    end_wanted_ = true;
  }
}

// Waits until the other process has finished its run and written what it keeps, or no more is to be expected of it.
void Enrolment::wait_for_hand_over(std::int32_t other, const tape::ProcessKeyframes* keyframes) {
  const auto has_ended_run = [this] {
    return slot_->done.load(std::memory_order_acquire) == slot_->taken.load(std::memory_order_seq_cst);
  };
  const std::uint64_t started = vars::process_start_time(other);
  const auto has_handed_over = [keyframes, other, started] {
    return keyframes == nullptr || keyframes->words().hand_over.load(std::memory_order_acquire) != HandOver::None ||
           !vars::process_alive(other, started);
  };
  while (!(has_ended_run() && has_handed_over()) && slot_->stop.load(std::memory_order_acquire) == 0 &&
         slot_->may_follow.load(std::memory_order_acquire) == enrolled_as_ && mapping_->node_alive()) {
    rt::sleep_until(rt::mono_time(rt::now_ns() + kLastRunPollNs));
  }
}

// Returns true if this process has what the other one kept. `theirs`: null if that one does not declare it.
bool Enrolment::take_over(const tape::ProcessKeyframes* theirs) {
  return kept_ && theirs != nullptr && theirs->words().hand_over.load(std::memory_order_acquire) == HandOver::Written &&
         kept_->take_over(*theirs);
}

// From now on the node releases this process.
void Enrolment::follow() {
  const scheduler::RunBlock& run = mapping_->block();
  const std::uint32_t module = hot.process_module.load(std::memory_order_relaxed);
  const bool returns = kept_ == nullptr;  // if it keeps anything, it has values of its own to continue with
  if (returns) {
    kept_ = KeptThread::prepare(node_, module, run);
  }
  const auto theirs = tape::ProcessKeyframes::open(node_, module, run.node_pid.load(std::memory_order_relaxed));
  const tape::ProcessKeyframes* const keyframes = theirs ? &theirs.value() : nullptr;
  std::int32_t other = slot_->pid.exchange(enrolled_as_, std::memory_order_seq_cst);
  other = other == enrolled_as_ ? slot_->left.load(std::memory_order_acquire) : other;
  slot_->wake.wake();  // the other one gives way
  wait_for_hand_over(other, keyframes);
  const bool carries = take_over(keyframes);
  if (!carries && keyframes != nullptr && kept_ && !returns && !kept_->may_lose()) {
    std::fprintf(stderr, "indurop: what the process before this one keeps cannot be taken over; this one ends\n");
    end_wanted_ = true;
    exit_code_ = kFailed;
    return;
  }
  if (tape_) {
    tape_->track().go_on(slot_->version.load(), carries ? tape::kExchanged : tape::kExchanged | tape::kRestarted);
  }
  start_keyframes();
  seen_ = slot_->taken.load(std::memory_order_seq_cst);
  slot_->obtained_fifo.store(rt::fifo_priority(), std::memory_order_relaxed);
  running_ = false;
  idle_ = 0;
  phase_ = Phase::Enrolled;
  slot_->follow_tick.store(slot_->release_tick.load(std::memory_order_relaxed), std::memory_order_relaxed);
  slot_->followed.store(enrolled_as_, std::memory_order_release);
}

// Another process follows, and its first release is the next one.
bool Enrolment::has_run_last() const noexcept {
  const std::int32_t next = slot_->may_follow.load(std::memory_order_acquire);
  if (next == 0 || next == enrolled_as_ || slot_->successor.load(std::memory_order_acquire) != next) {
    return false;
  }
  const std::uint64_t from = slot_->follow_from.load(std::memory_order_relaxed);
  if (slot_->released.load(std::memory_order_acquire) > seen_) {
    return slot_->release_tick.load(std::memory_order_relaxed) >= from;
  }
  const scheduler::RunBlock& run = mapping_->block();
  const std::int64_t period_ns =
      run.modules()[hot.process_module.load(std::memory_order_relaxed)].period_ns.load();  // 0: it is not known
  const std::uint64_t last = release_tick_.load(std::memory_order_relaxed);
  return last > 0 && period_ns > 0 && last + static_cast<std::uint64_t>(period_ns / run.basic_period_ns) >= from;
}

void Enrolment::pass_on() {
  slot_->left.store(enrolled_as_, std::memory_order_release);
  std::int32_t own = enrolled_as_;
  (void)slot_->pid.compare_exchange_strong(own, slot_->may_follow.load(std::memory_order_acquire),
                                           std::memory_order_seq_cst);
}

// Another process is released now.
void Enrolment::give_way() {
  slot_->wake.wake();  // if this process was woken in its place
  if (kept_) {
    kept_->hand_over();  // the other one waits for it
  }
  slot_->turn.wake();
  (void)rt::set_fifo(0);  // nothing that it does from here on, such as ending, delays a module
  close_records();
  const std::int32_t holder = slot_->pid.load(std::memory_order_acquire);
  if (slot_->previous.load(std::memory_order_acquire) == enrolled_as_ ||
      slot_->may_follow.load(std::memory_order_acquire) == enrolled_as_) {
    phase_ = Phase::Turn;
    return;
  }
  if (slot_->may_follow.load(std::memory_order_acquire) != holder) {
    std::fprintf(stderr, "indurop: node '%s' has another process for this module; this one ends\n", node_.c_str());
  }
  end_wanted_ = true;
}

}  // namespace indurop::runtime
