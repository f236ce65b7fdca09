// SPDX-License-Identifier: Apache-2.0
#include "node/replay/replay.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <utility>

#include "node/replay/kept_report.h"
#include "node/replay/notes.h"

namespace indurop::node {
namespace {

constexpr std::chrono::hours kReaderOfReplay{24};  // it loses nothing: no device waits for it

// Returns whether it is a value from before any module was started.
bool is_first_value(const RecordedRuns::Item& item) {
  const auto* value = std::get_if<RecordedValue>(&item);
  return value != nullptr && value->words.kind == tape::EntryKind::Run;
}

}  // namespace

Replay::Replay(const Options& options, Console& console, base::StopSignal& signals, const Checked& checked,
               const Prepared& prepared, Loaded& loaded)
    : options_(options),
      console_(console),
      signals_(signals),
      checked_(checked),
      store_(*prepared.store),
      modules_(options, console, checked, prepared, loaded),
      versions_(options, console, checked, prepared, loaded.libraries),
      repeater_(options, console, signals, checked, prepared, loaded),
      comparison_(store_, console) {}

bool Replay::begin(const RecordedRuns& recorded) {
  modules_.find_begin();
  const bool any = versions_.begin(modules_, repeater_) && modules_.look_ahead();
  const explain::Facts facts = recorded.facts();
  print_notes(checked_, modules_, recorded, facts, console_);
  comparison_.expect_forces(ForcedThen(facts.orders));
  const auto& all = modules_.all();
  const bool processes =
      std::any_of(all.begin(), all.end(), [](const auto& module) { return module->runs && module->is_process(); });
  if (!any || (processes && !repeater_.prepare_processes())) {
    return false;
  }
  for (const std::string& name : recorded.unknown_variables()) {
    console_.warning("{} of the recording is not in this configuration", name);
  }
  if (checked_.alone) {
    alone_.emplace(*modules_.all()[*checked_.alone], store_);
  }
  repeated_.closed = recorded.complete();
  if (!repeated_.closed) {
    console_.warning("the recording was not closed: it is replayed as far as it goes");
  }
  return true;
}

// Runs before this one are missing, and nothing tells what the module kept inside.
void Replay::note_doubt(ReplayedModule& module, std::uint64_t tick) {
  const std::string reason = module.kept.why_none();
  if (alone_) {
    alone_->begin_with_initial_values(reason);
    (void)module.kept.take_missing();
    return;
  }
  console_.warning(
      "{} runs of {} before tick {} are not in the recording: its internal state may differ from here on; {}",
      module.kept.take_missing(), module.state.record->name, tick, reason);
}

// Returns false for a run that cannot be repeated because not all is known that it began with.
bool Replay::can_repeat(ReplayedModule& module, const recorder::RunWords& run, bool is_restarted) {
  if (module.seen > 0 && run.tail.number != module.next_number) {
    module.forget_older_values();  // inputs of missing runs are missing, too
  }
  module.next_number = run.tail.number + 1;
  const bool known = module.knows_inputs();
  module.too_early += known ? 0U : 1U;
  const bool begins = std::exchange(module.begins_again, false) || is_restarted;
  const ReplayedMemory::Next next = module.kept.next(run.tail.number, begins, known && !module.lacks_version);
  module.restores = next == ReplayedMemory::Next::Restore;
  if (module.restores) {
    module.begin_with_recorded();
  }
  if (next == ReplayedMemory::Next::Doubt) {
    note_doubt(module, run.tail.tick);
  }
  module.note_knowledge(next, begins);
  return next != ReplayedMemory::Next::Wait;
}

// One file repeats the runs: what another version did comes from the recording, from this run on.
void Replay::end_at_exchange(ReplayedModule& module, const recorder::RunWords& run) {
  console_.warning(
      "module {} was exchanged while it ran: from tick {} on its runs are another version's, which are not repeated; "
      "with the file of that version, --from {} repeats them from the next keyframe on",
      module.name, run.tail.tick, run.tail.tick);
  for (const RecordedOutput& output : module.outputs) {
    (void)store_.write(store_.directory()[module.known[output.place].variable], 0, output.bytes);
  }
  module.take_outputs();
  module.runs = false;
  module.why_not = "it was exchanged before this tick";
}

// All threads stop, so that the store shows what the next run begins with for as long as a debugger needs.
void Replay::stop_for_debugger(const recorder::RunWords& next) {
  stopped_ = true;
  const ReplayedModule* const module = modules_.of_recording(next.module);
  console_.info("stopped before tick {}, the next run is one of {}: gdb -p {pid}, or kill -CONT {pid}", next.tail.tick,
                module != nullptr ? module->name : "a module that is not here", fmt::arg("pid", ::getpid()));
  (void)::raise(SIGSTOP);
}

// Returns whether no run of a wanted tick follows: this one was released long after the last of these ticks. What a run
// that takes even longer wrote is not compared.
bool Replay::is_past_the_end(const recorder::RunWords& run) noexcept {
  constexpr std::int64_t kLateNs = 1'000'000'000;
  if (run.tail.tick <= options_.replay.to_tick) {
    end_ns_ = std::max(end_ns_, run.tail.release_ns);
    return false;
  }
  end_ns_ = end_ns_ == 0 ? run.tail.release_ns : end_ns_;
  return run.tail.release_ns > end_ns_ + kLateNs;
}

// Returns false if the replay cannot continue.
bool Replay::replay_run(const recorder::RunWords& run) {
  if (run.tail.tick > options_.replay.to_tick) {
    return true;
  }
  if (run.tail.tick >= options_.replay.stop_tick && !stopped_) {
    stop_for_debugger(run);
  }
  repeated_.ticks = std::max(repeated_.ticks, run.tail.tick + 1);
  ReplayedModule* const of_run = modules_.of_recording(run.module);
  if (of_run == nullptr) {
    repeated_.runs_not_here += modules_.is_recorded(run.module) ? 1U : 0U;
    return true;
  }
  ReplayedModule& module = *of_run;
  if (module.apart) {
    return true;
  }
  if (!module.runs) {
    module.left_out += module.unknown_inputs.empty() ? 0U : 1U;
    return true;
  }
  if (run.exchanged && module.repeated > 0 && !versions_.follows(module)) {
    end_at_exchange(module, run);
    return true;
  }
  if (!versions_.prepare(module, run, repeater_)) {
    return false;
  }
  const bool is_restarted = !std::exchange(module.continues, false) && run.anew;
  module.restart_due = module.restart_due || is_restarted;
  module.lacking += module.lacks_version && run.tail.tick >= options_.replay.from_tick ? 1U : 0U;
  const bool can = can_repeat(module, run, is_restarted);
  if (can && module.seen == 0 && !alone_) {
    modules_.write_first_outputs(module);
  }
  versions_.prepare_return(module, run);
  const bool can_continue = !can || repeater_.repeat(module, run);
  module.take_outputs();
  if (!can) {
    module.write_outputs(store_);
  } else if (alone_) {
    module.note_disturbance();
  }
  ++module.seen;
  if (can && can_continue && run.tail.tick >= options_.replay.from_tick) {
    ++repeated_.runs;
    ++module.repeated;
    comparison_.compare(module, run);
    if (alone_) {
      alone_->note(run);
    }
  }
  return can_continue;
}

void Replay::take(const RecordedClock& clock) {
  if (ReplayedModule* const module = modules_.of_recording(clock.module); module != nullptr) {
    module->clock.push_back(clock.now_ns);
  }
}

void Replay::take(const RecordedAnswer& answer) {
  if (ReplayedModule* const module = modules_.of_recording(answer.module); module != nullptr) {
    module->codes.push_back(answer.words.code);
    module->answers.emplace_back(answer.words.bytes.begin(), answer.words.bytes.end());
  }
}

void Replay::take(const RecordedKeyframe& keyframe) {
  if (ReplayedModule* const module = modules_.of_recording(keyframe.module); module != nullptr) {
    module->kept.take(keyframe.words, *keyframe.form);
  }
}

// The modules are started with the values from before the first module started; one that is compared alone, with those
// from before its first run. `run`: the run that is to be repeated next, null: a value is next.
bool Replay::start(const recorder::RunWords* run) {
  if (started_) {
    return true;
  }
  if (alone_) {
    if (run == nullptr || modules_.of_recording(run->module) != &alone_->module()) {
      return true;
    }
    alone_->module().write_inputs(store_);
  }
  started_ = true;
  return repeater_.start(modules_);
}

bool Replay::replay(RecordedRuns& recorded) {
  for (;;) {
    auto item = recorded.next();
    if (!item) {
      console_.warning("{}", item.error().text);
      repeated_.damaged = true;
      continue;
    }
    if (!*item) {
      return true;
    }
    if (modules_.begin_ns() > 0 && !started_ && !is_first_value(**item)) {
      if (!start(nullptr)) {
        return false;
      }
      modules_.begin_late();
      recorded.seek(modules_.begin_ns());
      continue;
    }
    if (const auto* clock = std::get_if<RecordedClock>(&**item); clock != nullptr) {
      take(*clock);
    } else if (const auto* answer = std::get_if<RecordedAnswer>(&**item); answer != nullptr) {
      take(*answer);
    } else if (const auto* keyframe = std::get_if<RecordedKeyframe>(&**item); keyframe != nullptr) {
      take(*keyframe);
    } else if (const auto* value = std::get_if<RecordedValue>(&**item); value != nullptr) {
      if (!(is_first_value(**item) || start(nullptr)) || !modules_.take(*value)) {
        return false;
      }
    } else if (const auto& run = std::get<RecordedRun>(**item).words; is_past_the_end(run)) {
      return true;
    } else if (!start(&run) || !replay_run(run)) {
      return false;
    }
    console_.print_messages(rt::MonoClock::now(), kReaderOfReplay);
    if (signals_.wait(std::chrono::nanoseconds{0}) != 0) {
      console_.error("interrupted");
      return false;
    }
  }
}

Ending Replay::conclude() {
  if (!alone_ || repeated_.runs == 0) {
    return node::conclude(options_.replay, modules_, comparison_, repeated_, store_, console_);
  }
  if (const auto written = alone_->write(options_.replay.report, modules_.others()); !written) {
    console_.error("{}", written.error().text);
    return {kFailed, "the report cannot be written"};
  }
  return {kOk, "end of the recording"};
}

Ending Replay::run() {
  if (checked_.alone) {
    if (const auto node = RecordedRuns::node_of(options_.replay.file, options_.replay.board); node) {
      modules_.compare_with_node(*node, *checked_.alone);
    }
  }
  auto recorded = RecordedRuns::open(options_.replay.file, options_.replay.board, store_, modules_.others().former);
  if (!recorded) {
    console_.error("{}", recorded.error().text);
    return {recorded.error().code, "the recording cannot be replayed"};
  }
  modules_.choose(*recorded);
  const std::size_t variables = store_.directory().size();
  if (!versions_.load(*recorded, modules_)) {
    return {kFailed, "the recording cannot be replayed"};
  }
  if (store_.directory().size() > variables) {
    recorded = RecordedRuns::open(options_.replay.file, options_.replay.board, store_);  // with those of the versions
  }
  if (!recorded || !begin(*recorded)) {
    return {kFailed, "the recording cannot be replayed"};
  }
  if (!options_.replay.output.empty() &&
      !comparison_.open_output(options_.replay.output, options_.replay.file.string(), recorded->real_minus_node_ns())) {
    return {kFailed, "what modules leave cannot be written"};
  }
  repeater_.attach();
  bool whole = replay(*recorded);
  if (const auto& file = options_.replay.kept; whole && !file.empty()) {
    if (const auto written = write_kept(file, options_.replay.to_tick, modules_, comparison_,
                                        [this](const ReplayedModule& module) { return repeater_.memory_of(module); });
        !written) {
      console_.error("{}", written.error().text);
      whole = false;
    }
  }
  versions_.end(modules_, repeater_);
  repeater_.stop();
  console_.print_messages(rt::MonoClock::now(), kReaderOfReplay);
  console_.report_losses();
  comparison_.close_output();
  return whole ? conclude() : Ending{kFailed, "the recording was not replayed to its end"};
}

}  // namespace indurop::node
