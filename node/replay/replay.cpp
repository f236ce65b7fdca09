// SPDX-License-Identifier: Apache-2.0
#include "node/replay/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "config/check/determinism.h"
#include "core/base/duration.h"
#include "node/modules/hang_watch.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

using scheduler::ModuleState;
using scheduler::ModuleType;
using scheduler::Operation;

constexpr std::chrono::seconds kReplayPatience{10};  // for a process, in real time
constexpr std::chrono::microseconds kReplayPoll{50};

bool names(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

// Returns why the module is not run again; empty: it is.
std::string reason_to_leave_out(const config::Module& module, const std::vector<std::string>& imports) {
  if (module.operation == Operation::NonReal) {
    return "it runs in the background";
  }
  if (module.signal != 0) {
    return "it does not say when a run ends";
  }
  if (module.type == ModuleType::Process) {
    return "";
  }
  return config::talks_to_others(imports) ? "it speaks to devices or the network" : "";
}

}  // namespace

void Replay::Kernel::set(std::int64_t ns) noexcept {
  for (auto* shown : shown_) {
    shown->store(ns, std::memory_order_relaxed);
  }
}

Replay::Replay(const Options& options, Console& console, base::StopSignal& signals, Checked& checked,
               Prepared& prepared, Loaded& loaded)
    : options_(options),
      console_(console),
      signals_(signals),
      checked_(checked),
      prepared_(prepared),
      libraries_(loaded.libraries),
      run_(prepared.run()),
      kernel_({&prepared.store->virtual_time(), &run_.virtual_ns}),
      runner_(run_, kernel_, run_hooks(), trace_, 1),
      phases_(checked.config, run_, loaded.libraries, console, signals, hooks(), kernel_),
      processes_(checked.config, run_, options.node, false, console, *prepared.failsafe, nullptr) {
  kernel_.set(rt::kNanosPerSecond);
  for (std::size_t i = 0; i < checked.config.modules.size(); ++i) {
    modules_.push_back(std::make_unique<Module>());
  }
  for (const scheduler::Task& task : loaded.tasks) {
    scheduler::TaskState& state = modules_[task.index]->state;
    state.task = task;
    state.task.condition = Condition{};  // it was true in the recording
    state.record = &run_.modules()[task.index];
    state.slot = &run_.process_slots()[task.index];
  }
}

Replay::~Replay() = default;

scheduler::Hooks Replay::hooks() {
  scheduler::Hooks hooks;
  hooks.context = this;
  hooks.entering = [](void*, std::uint32_t module, std::uint64_t, std::int64_t) noexcept {
    runtime::set_current_module(module);
  };
  hooks.faulted = [](void* context, std::uint32_t /*module*/) noexcept {
    static_cast<Replay*>(context)->prepared_.store->release_locks_of_this_thread();
    runtime::release_calls_of_this_thread();
  };
  return hooks;
}

scheduler::Hooks Replay::run_hooks() {
  scheduler::Hooks hooks = this->hooks();
  hooks.entering = [](void*, std::uint32_t module, std::uint64_t tick, std::int64_t release_ns) noexcept {
    runtime::set_current_run(module, {tick, release_ns});
  };
  return hooks;
}

const schema::Variable& Replay::variable(std::uint32_t index) const {
  const vars::Store& store = *prepared_.store;
  return store.schema().variables[store.directory()[index].schema_index];
}

// Returns the module of this configuration that corresponds to a module of the recording; kNoSuchModule: none.
std::uint32_t Replay::configured(std::uint32_t recorded) const noexcept {
  return recorded < of_recording_.size() ? of_recording_[recorded] : kNoSuchModule;
}

bool Replay::choose_modules(const RecordedRuns& recorded) {
  const auto& configured = checked_.config.modules;
  for (const std::string& name : recorded.modules()) {
    const auto found =
        std::find_if(configured.begin(), configured.end(), [&](const auto& module) { return module.name == name; });
    of_recording_.push_back(found == configured.end() ? kNoSuchModule
                                                      : static_cast<std::uint32_t>(found - configured.begin()));
    if (found == configured.end()) {
      console_.warning("module {} of the recording is not in this configuration: its runs are not repeated", name);
    }
  }
  for (std::size_t i = 0; i < configured.size(); ++i) {
    Module& module = *modules_[i];
    const bool known = names(recorded.modules(), configured[i].name);
    module.why_not =
        known ? reason_to_leave_out(configured[i], checked_.check.facts[i].file.imports) : "it is not in the recording";
    module.runs = module.why_not.empty();
    module.kept.expect(libraries_[i].memory(), recorded.has_keyframes(configured[i].name));
    if (!module.runs) {
      console_.info("module {} does not run: {}; what it wrote comes from the recording", configured[i].name,
                    module.why_not);
    }
  }
  for (const config::VariableUse& use : checked_.check.uses) {
    const auto* entry = prepared_.store->find(abi::fnv1a64(use.name.data(), use.name.size()));
    for (std::size_t i = 0; entry != nullptr && i < configured.size(); ++i) {
      Known known;
      known.variable = static_cast<std::uint32_t>(entry - prepared_.store->directory().data());
      known.read = names(use.readers, configured[i].name);
      known.written = names(use.writers, configured[i].name);
      if (known.read || known.written) {
        modules_[i]->place[known.variable] = modules_[i]->known.size();
        modules_[i]->known.push_back(std::move(known));
      }
    }
  }
  look_ahead();
  find_keyframes_to_begin_at();
  const bool any = std::any_of(modules_.begin(), modules_.end(), [](const auto& module) { return module->runs; });
  if (!any) {
    console_.error("no module of {} can run again", options_.replay.file.string());
  }
  warn_about_conditions();
  warn_about_format(recorded);
  const explain::Facts facts = recorded.facts();
  warn_about_schedule(facts);
  forced_then_ = ForcedThen(facts.orders);
  return any;
}

bool Replay::begin(const RecordedRuns& recorded) {
  if (!choose_modules(recorded)) {
    return false;
  }
  const bool processes = std::any_of(modules_.begin(), modules_.end(), [](const auto& module) {
    return module->runs && module->state.task.type == ModuleType::Process;
  });
  if (processes) {
    auto input = tape::ReplayInputWriter::create(options_.node, run_.node_pid.load());
    if (!input) {
      console_.error("the recorded inputs cannot be passed to process modules: {}", describe(input.error()));
      return false;
    }
    replay_input_.emplace(std::move(input).value());
  }
  for (const std::string& name : recorded.unknown_variables()) {
    console_.warning("{} of the recording is not in this configuration", name);
  }
  closed_ = recorded.complete();
  if (!closed_) {
    console_.warning("the recording was not closed: it is replayed as far as it goes");
  }
  return true;
}

std::vector<tape::ReplayedAnswer> Replay::Module::replayed_answers() const {
  std::vector<tape::ReplayedAnswer> all;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    all.push_back({codes[i], answers[i]});
  }
  return all;
}

// Returns false for a run that cannot be repeated because not all is known that it began with.
bool Replay::can_repeat(Module& module, const recorder::RunWords& run) {
  if (module.seen > 0 && run.tail.number != module.next_number) {
    forget(module);  // inputs of missing runs are missing, too
  }
  module.next_number = run.tail.number + 1;
  const bool known = knows_inputs(module);
  module.too_early += known ? 0U : 1U;
  const ReplayedMemory::Next next = module.kept.next(run.tail.number, run.anew, known);
  module.restores = next == ReplayedMemory::Next::Restore;
  if (next == ReplayedMemory::Next::Doubt) {
    doubt(module, run.tail.tick);
  }
  return next != ReplayedMemory::Next::Wait;
}

bool Replay::replay_run(const recorder::RunWords& run) {
  if (run.tail.tick > options_.replay.to_tick) {
    return true;
  }
  const std::uint32_t index = configured(run.module);
  ticks_ = std::max(ticks_, run.tail.tick + 1);
  if (index == kNoSuchModule && run.module < of_recording_.size()) {  // else values that no module reads or writes
    ++runs_not_here_;
  }
  if (index == kNoSuchModule || modules_[index]->apart) {
    return true;
  }
  Module& module = *modules_[index];
  if (!module.runs) {
    module.left_out += module.unknown_inputs.empty() ? 0U : 1U;
    return true;
  }
  module.restart_due = module.restart_due || run.anew;
  const bool can = can_repeat(module, run);
  const bool can_continue = !can || repeat(module, index, run);
  module.clock.clear();
  module.codes.clear();
  module.answers.clear();
  take_recorded_outputs(module);
  ++module.seen;
  if (can && can_continue && is_wanted(run.tail.tick)) {
    compare(module, index, run);
  }
  return can_continue;
}

// Returns false if the replay cannot continue.
bool Replay::repeat(Module& module, std::uint32_t index, const recorder::RunWords& run) {
  run_.epoch_ns = run.tail.release_ns - static_cast<std::int64_t>(run.tail.tick) * run_.basic_period_ns;
  run_.tick.store(run.tail.tick + 1);
  // A module that polls the clock waits for a time: after its recorded clock readings, that time has come.
  kernel_.set(module.clock.size() < std::size_t{tape::kMaxReadings} ? run.tail.start_ns : run.tail.end_ns);
  give_inputs(module);
  if (std::exchange(module.restart_due, false)) {
    if (!restart(module, index)) {
      return false;
    }
    give_inputs(module);  // its start may have written variables
  }
  if (std::exchange(module.restores, false)) {
    restore(module);
  }
  if (module.state.task.type == ModuleType::Process) {
    run_process(module, index, run.tail);
  } else {
    scheduler::TaskState* state = &module.state;
    const std::vector<tape::ReplayedAnswer> answers = module.replayed_answers();
    runtime::set_clock_readings(module.clock);
    runtime::set_answers(answers);
    runner_.run({&state, 1}, run.tail.tick, rt::mono_time(run.tail.release_ns));
    runtime::set_clock_readings({});
    runtime::set_answers({});
  }
  runs_ += is_wanted(run.tail.tick) ? 1U : 0U;
  module.repeated += is_wanted(run.tail.tick) ? 1U : 0U;
  returned_.fetch_add(1, std::memory_order_relaxed);
  return true;
}

bool Replay::start_modules() {
  for (std::size_t i = 0; i < modules_.size(); ++i) {
    if (!modules_[i]->runs) {
      run_.modules()[i].state.store(ModuleState::Stopped);
    }
  }
  if (!phases_.call_all("start", &ModuleDescriptor::start)) {
    console_.error("a module could not be started: nothing was run");
    return false;
  }
  if (const Status served = runtime::start_function_servers(0, -1); !served) {
    console_.error("shared functions cannot be served: {}", describe(served.error()));
    return false;
  }
  for (std::uint32_t i = 0; i < modules_.size(); ++i) {
    if (modules_[i]->runs && modules_[i]->state.task.type == ModuleType::Process && !processes_.start(i)) {
      return false;
    }
  }
  const rt::MonoTime until = rt::MonoClock::now() + kReplayPatience;
  while (!processes_.ready() && rt::MonoClock::now() < until && signals_.wait(kReplayPoll) == 0) {
    (void)processes_.supervise(rt::MonoClock::now(), kernel_.now());
  }
  for (const auto& module : modules_) {
    if (module->runs && module->state.task.type == ModuleType::Thread) {
      module->state.record->state.store(ModuleState::Running);
    }
  }
  run_.state.store(scheduler::NodeState::Running);
  return true;
}

// The modules are started with the values from before the first module started.
bool Replay::replay(RecordedRuns& recorded) {
  bool started = false;
  const auto start = [&] { return std::exchange(started, true) || start_modules(); };
  for (;;) {
    auto item = recorded.next();
    if (!item) {
      console_.warning("{}", item.error().text);
      damaged_ = true;
      continue;
    }
    if (!*item) {
      return true;
    }
    const auto* value = std::get_if<RecordedValue>(&**item);
    if (const auto* clock = std::get_if<RecordedClock>(&**item); clock != nullptr) {
      if (const std::uint32_t index = configured(clock->module); index != kNoSuchModule) {
        modules_[index]->clock.push_back(clock->now_ns);
      }
    } else if (const auto* answer = std::get_if<RecordedAnswer>(&**item); answer != nullptr) {
      if (const std::uint32_t index = configured(answer->module); index != kNoSuchModule) {
        modules_[index]->codes.push_back(answer->words.code);
        modules_[index]->answers.emplace_back(answer->words.bytes.begin(), answer->words.bytes.end());
      }
    } else if (const auto* keyframe = std::get_if<RecordedKeyframe>(&**item); keyframe != nullptr) {
      if (const std::uint32_t index = configured(keyframe->module); index != kNoSuchModule) {
        modules_[index]->kept.take(keyframe->words, *keyframe->form);
      }
    } else if (value != nullptr) {
      const bool first = value->words.kind == tape::EntryKind::Run;
      if (!(first || start()) || !take(*value)) {
        return false;
      }
    } else if (!start() || !replay_run(std::get<RecordedRun>(**item).words)) {
      return false;
    }
    console_.print_messages(rt::MonoClock::now());
    if (signals_.wait(std::chrono::nanoseconds{0}) != 0) {
      console_.error("interrupted");
      return false;
    }
  }
}

Ending Replay::run() {
  auto recorded = RecordedRuns::open(options_.replay.file, options_.replay.board, *prepared_.store);
  if (!recorded) {
    console_.error("{}", recorded.error().text);
    return {recorded.error().code, "the recording cannot be replayed"};
  }
  if (!begin(*recorded)) {
    return {kFailed, "the recording cannot be replayed"};
  }
  if (!options_.replay.output.empty()) {
    auto output = ReplayOutput::create(options_.replay.output, options_.replay.file.string());
    if (!output) {
      console_.error("{}", output.error().text);
      return {kFailed, "what modules leave cannot be written"};
    }
    output_ = std::move(output).value();
    real_minus_node_ns_ = recorded->real_minus_node_ns();
  }
  rt::install_guard_handlers();
  runner_.attach_thread();
  HangWatch hang_watch([this] { return returned_.load(std::memory_order_relaxed); },
                       [this] { runner_.enforce_budget(kernel_.now() + kReplayPatience, true, 0); });
  const bool whole = replay(*recorded);
  runner_.detach_thread();
  run_.state.store(scheduler::NodeState::Stopping);
  processes_.end_all();
  runtime::stop_function_servers();
  (void)phases_.call_all("stop", &ModuleDescriptor::stop);
  console_.print_messages(rt::MonoClock::now());
  console_.report_losses();
  close_output();
  return whole ? conclude() : Ending{kFailed, "the recording was not replayed to its end"};
}

}  // namespace indurop::node
