// SPDX-License-Identifier: Apache-2.0
// Two processes of one module, while the node exchanges the one for the other: both wait in irp::waitPeriod(), and one
// of them is released. Each release is taken by one process only, so the one that is followed finishes its run, and no
// release is lost.

#include <cstdio>

#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "store/runtime/enrolment.h"
#include "store/runtime/process.h"

namespace indurop::runtime {

namespace {

constexpr std::int64_t kLastRunPollNs = 200'000;

}  // namespace

// Tape and keyframes of the module. One process at a time has them open.
void Enrolment::open_records() {
  const std::uint32_t module = hot.process_module.load(std::memory_order_relaxed);
  set_current_track(nullptr);
  kept_.reset();
  tape_.reset();
  if (const Attachment* attachment = hot.attachment.load(std::memory_order_acquire)) {
    if (auto member = tape::Member::open(node_, module, attachment->store())) {
      tape_ = std::move(member).value();
    }
  }
  kept_ = KeptThread::begin(node_, module, mapping_->block(), tape_ ? &tape_->track() : nullptr);
}

void Enrolment::wait_for_turn() {
  const auto is_this = [this](const std::atomic<std::int32_t>& pid) {
    return pid.load(std::memory_order_acquire) == enrolled_as_;
  };
  if (is_this(slot_->may_follow)) {
    follow();
  } else if (mapping_->node_alive() && (is_this(slot_->successor) || is_this(slot_->previous))) {
    slot_->ready.store(enrolled_as_, std::memory_order_release);
    (void)slot_->turn.wait_until(rt::mono_time(rt::now_ns() + kIdleNs));
  } else {
    end_wanted_ = true;
  }
}

// From now on the node releases this process.
void Enrolment::follow() {
  const scheduler::RunBlock& run = mapping_->block();
  if (run.virtual_ns.load(std::memory_order_relaxed) == 0) {
    take_priority(run.modules()[hot.process_module.load(std::memory_order_relaxed)]);
  }
  slot_->pid.store(enrolled_as_, std::memory_order_seq_cst);
  slot_->wake.wake();  // the other one gives way
  while (slot_->done.load(std::memory_order_acquire) != slot_->taken.load(std::memory_order_seq_cst) &&
         slot_->stop.load(std::memory_order_acquire) == 0 && mapping_->node_alive()) {
    rt::sleep_until(rt::mono_time(rt::now_ns() + kLastRunPollNs));
  }
  open_records();
  seen_ = slot_->taken.load(std::memory_order_seq_cst);
  slot_->obtained_fifo.store(rt::fifo_priority(), std::memory_order_relaxed);
  running_ = false;
  idle_ = 0;
  phase_ = Phase::Enrolled;
  slot_->follow_tick.store(slot_->release_tick.load(std::memory_order_relaxed), std::memory_order_relaxed);
  slot_->followed.store(enrolled_as_, std::memory_order_release);
}

// Another process is released now.
void Enrolment::give_way() {
  slot_->wake.wake();     // if this process was woken in its place
  (void)rt::set_fifo(0);  // nothing that it does from here on, such as ending, delays a module
  set_current_track(nullptr);
  kept_.reset();
  tape_.reset();
  const std::int32_t holder = slot_->pid.load(std::memory_order_acquire);
  if (slot_->previous.load(std::memory_order_acquire) == enrolled_as_) {
    phase_ = Phase::Turn;
    return;
  }
  if (slot_->may_follow.load(std::memory_order_acquire) != holder) {
    std::fprintf(stderr, "indurop: node '%s' has another process for this module; this one ends\n", node_.c_str());
  }
  end_wanted_ = true;
}

}  // namespace indurop::runtime
