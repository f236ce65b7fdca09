// SPDX-License-Identifier: Apache-2.0
// How a replay repeats events that the values do not show: processes run and die, modules that were restarted are
// restarted again, and what a module kept inside is put back.

#include <thread>
#include <utility>

#include "core/rt/relax.h"
#include "node/replay/repeater.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

constexpr std::chrono::seconds kRestartPatience{10};
constexpr std::chrono::milliseconds kRestartPoll{1};
constexpr int kPollsBeforeSleep = 2000;
constexpr std::chrono::microseconds kShortPause{50};

}  // namespace

bool Repeater::call(std::uint32_t index, const char* phase, void (*function)()) {
  if (function == nullptr) {
    return true;
  }
  auto call = phases_.begin(index, phase, function);
  while (call != nullptr && !phases_.ended(*call, rt::MonoClock::now(), Phases::kGrace)) {
    std::this_thread::sleep_for(kRestartPoll);
  }
  return call != nullptr && phases_.conclude(std::move(call));
}

std::optional<std::string> Repeater::call_apart(const ReplayedModule& module, const ModuleLibrary& version,
                                                const char* phase, void (*function)()) {
  if (function == nullptr) {
    return std::nullopt;
  }
  runtime::bind_apart(version.inside());
  auto call = phases_.begin(module.index, phase, function);
  while (call != nullptr && !phases_.ended(*call, rt::MonoClock::now(), kRestartPatience)) {
    std::this_thread::sleep_for(kRestartPoll);
  }
  auto failure =
      call == nullptr ? std::optional<std::string>("it cannot be called") : Phases::failure_of(std::move(call));
  runtime::bind_back(version.inside());
  return failure;
}

bool Repeater::start_apart(const ReplayedModule& module, const ModuleLibrary& version) {
  const auto failure = call_apart(module, version, "start", version.functions().start);
  if (failure) {
    console_.error("module {}: of {}: {}", module.name, version.file().string(), *failure);
  }
  return !failure;
}

void Repeater::stop_apart(const ReplayedModule& module, const ModuleLibrary& version) {
  if (const auto failure = call_apart(module, version, "stop", version.functions().stop); failure) {
    console_.warning("module {}: of {}: {}", module.name, version.file().string(), *failure);
  }
}

void Repeater::stop_for_exchange(ReplayedModule& module) {
  (void)call(module.index, "stop", libraries_[module.index].functions().stop);  // a failure is reported
  module.was_stopped = true;
}

void Repeater::resume(ReplayedModule& module) {
  module.write_outputs(store_);
  module.state.record->state.store(scheduler::ModuleState::Running);
  module.state.gate.store(scheduler::Gate::Open);
}

// A process has unlimited time, as long as it lives. One that dies stays dead until it is restarted.
void Repeater::run_process(ReplayedModule& module, const tape::RunTail& tail) {
  scheduler::ProcessSlot& slot = *module.state.slot;
  replay_input_->give(module.clock, module.replayed_answers());
  const std::uint64_t release = slot.released.load() + 1;
  slot.release_ns.store(tail.release_ns);
  slot.release_tick.store(tail.tick);
  slot.released.store(release, std::memory_order_release);
  slot.wake.wake();
  const rt::MonoTime until = rt::MonoClock::now() + kRestartPatience;
  for (int polls = 0; slot.done.load(std::memory_order_acquire) != release; ++polls) {
    if (polls < kPollsBeforeSleep) {
      rt::relax();
      continue;
    }
    std::this_thread::sleep_for(kShortPause);
    if (rt::MonoClock::now() > until) {
      processes_.kill_hanging(module.index);
    }
    (void)processes_.supervise(rt::MonoClock::now(), kernel_.now());
    if (module.state.record->state.load() != scheduler::ModuleState::Running) {
      module.died = true;
      processes_.stop(module.index, rt::MonoClock::now());
      return;
    }
  }
}

bool Repeater::restart_process(std::uint32_t index) {
  const rt::MonoTime until = rt::MonoClock::now() + kRestartPatience;
  processes_.stop(index, rt::MonoClock::now());
  bool started = false;
  while (rt::MonoClock::now() < until) {
    (void)processes_.supervise(rt::MonoClock::now(), kernel_.now());
    if (!started && processes_.has_ended(index)) {
      started = processes_.start(index);
    } else if (started && run_.modules()[index].state.load() == scheduler::ModuleState::Running) {
      return true;
    }
    std::this_thread::sleep_for(kRestartPoll);
  }
  return false;
}

bool Repeater::restart(ReplayedModule& module) {
  bool good = true;
  if (module.is_process()) {
    module.died = false;
    good = restart_process(module.index);
    find_kept(module);
  } else {
    const auto& functions = libraries_[module.index].functions();
    if (!std::exchange(module.was_stopped, false)) {
      (void)call(module.index, "stop", functions.stop);  // a failure is reported
    }
    good = call(module.index, "start", functions.start);
    module.state.record->state.store(scheduler::ModuleState::Running);
    module.state.gate.store(scheduler::Gate::Open);
  }
  if (!good) {
    console_.error("module {} was restarted in the recording and could not be restarted now",
                   module.state.record->name);
  }
  return good;
}

void Repeater::find_kept(ReplayedModule& module) {
  if (module.runs && module.is_process()) {
    ReplayedProcess& kept = kept_[module.index];
    const bool declares = kept.open(options_.node, module.index, run_.node_pid.load());
    module.kept.know_process(declares, declares && kept.is_empty());
  }
}

std::optional<ReplayedProcess::State> Repeater::state_of(const ReplayedModule& module) {
  return module.died ? std::nullopt : kept_[module.index].state();
}

void Repeater::put_back(const ReplayedModule& module, const ReplayedProcess::State& state) {
  (void)kept_[module.index].restore(state.form, state.bytes);
}

void Repeater::set_program(const ReplayedModule& module, const std::filesystem::path& file) {
  (void)processes_.set_program(module.index, {.file = file});
}

const ModuleMemory* Repeater::memory_of(const ReplayedModule& module) {
  return module.is_process() ? kept_[module.index].memory() : module.kept.memory();
}

void Repeater::restore(const ReplayedModule& module) {
  const std::vector<std::string> differing = module.is_process()
                                                 ? kept_[module.index].restore(module.kept.form(), module.kept.bytes())
                                                 : module.kept.restore();
  for (const std::string& name : differing) {
    if (module.keeps_own) {
      continue;  // the plan of the exchange has it
    }
    console_.warning("module {}: {} cannot be put back: it is declared otherwise than in the recording",
                     module.state.record->name, name);
  }
}

}  // namespace indurop::node
