// SPDX-License-Identifier: Apache-2.0
// What a run does where the schedule calls it: on real-time threads.
#include "node/run/running.h"
#include "store/runtime/host.h"

namespace indurop::node {

scheduler::Hooks Running::plain_hooks() {
  scheduler::Hooks hooks;
  hooks.context = this;
  hooks.entering = [](void*, std::uint32_t module, std::uint64_t, std::int64_t) noexcept {
    runtime::set_current_module(module);
  };
  hooks.faulted = [](void* context, std::uint32_t module) noexcept {
    const Prepared& prepared = static_cast<Running*>(context)->prepared_;
    prepared.store->release_locks_of_this_thread();
    runtime::release_calls_of_this_thread();
    runtime::release_chunks_of(module);
    prepared.failsafe->apply(module);
  };
  hooks.stop_node = [](void* context, std::uint32_t module, const char* /*reason*/) noexcept {
    auto& self = *static_cast<Running*>(context);
    self.reported_.stop_order.store(module + 1, std::memory_order_release);
    self.engine_.request_stop();
  };
  if (checked_.mirror) {
    hooks.worked = [](void* context) noexcept { static_cast<Running*>(context)->mirror_.notify(); };
  }
  return hooks;
}

// The hooks of versions that are started or stopped while another version of their module runs.
scheduler::Hooks Running::apart_hooks() {
  scheduler::Hooks hooks = plain_hooks();
  hooks.faulted = [](void* context, std::uint32_t /*module*/) noexcept {
    static_cast<Running*>(context)->prepared_.store->release_locks_of_this_thread();
    runtime::release_calls_of_this_thread();
  };
  return hooks;
}

// The hooks of the schedule.
scheduler::Hooks Running::hooks() {
  scheduler::Hooks hooks = plain_hooks();
  hooks.entering = [](void*, std::uint32_t module, std::uint64_t tick, std::int64_t release_ns) noexcept {
    runtime::set_current_run(module, {tick, release_ns});
  };
  hooks.ticks = [](void* context, std::uint64_t tick, std::int64_t /*release_ns*/) noexcept {
    static_cast<Running*>(context)->change_batch(tick);
  };
  if (prepared_.tape) {
    set_tape(hooks, *prepared_.tape);
  }
  return hooks;
}

void Running::change_batch(std::uint64_t tick) noexcept {
  prepared_.batch.carry_out(*prepared_.store, tick);
}

// All inputs and outputs of a run go to the tape.
void Running::set_tape(scheduler::Hooks& hooks, const tape::Tape& tape) {
  hooks.soon = [](void* context, std::uint32_t module) noexcept {
    static_cast<Running*>(context)->prepared_.tape->soon(module);
  };
  hooks.begins = [](void* context, std::uint32_t module) noexcept {
    tape::Track* const track = static_cast<Running*>(context)->prepared_.tape->of(module);
    if (track == nullptr) {
      return false;
    }
    runtime::set_current_track(track);
    return track->begin();
  };
  hooks.ended = [](void* context, std::uint32_t module, std::uint64_t tick, const scheduler::RunTimes& times,
                   bool faulted) noexcept {
    tape::Tape& written = *static_cast<Running*>(context)->prepared_.tape;
    if (written.of(module) == nullptr) {
      return false;
    }
    runtime::set_current_track(nullptr);
    return written.end(module, {0, 0, tick, times.release_ns, times.start_ns, times.end_ns},
                       faulted ? std::uint32_t{tape::kFaulted} : 0U);
  };
  hooks.exchanged = [](void* context, std::uint32_t module) noexcept {
    if (tape::Track* const track = static_cast<Running*>(context)->prepared_.tape->of(module); track != nullptr) {
      track->note_exchange();
    }
  };
  if (tape.others() != nullptr) {
    hooks.ticks = [](void* context, std::uint64_t tick, std::int64_t release_ns) noexcept {
      auto& self = *static_cast<Running*>(context);
      self.change_batch(tick);
      const std::int64_t now = rt::to_ns(self.kernel_.now());
      self.prepared_.tape->others()->record_others({0, 0, tick, release_ns, now, now});
    };
  }
}

}  // namespace indurop::node
