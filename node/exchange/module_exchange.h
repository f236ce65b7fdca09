// SPDX-License-Identifier: Apache-2.0
// The exchange of one module while the node runs: its new version is checked, loaded and started next to the running
// one, follows it between two runs, and is watched for a while. Called by the thread that supervises the node.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "node/exchange/candidate.h"
#include "node/exchange/candidate_thread.h"
#include "node/exchange/guard_condition.h"
#include "node/exchange/retired.h"
#include "node/modules/processes.h"
#include "node/run/console.h"
#include "node/run/phases.h"
#include "scheduler/engine.h"
#include "scheduler/module_command.h"
#include "store/operate/reload.h"
#include "store/tape/tape.h"

namespace indurop::node {

// The parts of the node needed for exchanges, borrowed.
struct ExchangeParts {
  const std::string& node;
  const config::Config& config;
  scheduler::RunBlock& run;
  std::vector<ModuleLibrary>& libraries;  // the versions that run
  scheduler::Engine& engine;
  vars::Store& store;
  Console& console;
  Processes& processes;
  bool simulated = false;      // virtual time does not pass while a version is prepared
  bool may_grow = false;       // versions may bring variables that the store does not have
  bool keeps_types = false;    // others know the types of variables: topics
  tape::Tape* tape = nullptr;  // null: none
};

class ScheduleChange;

// What exchanges of several modules share.
struct ExchangeContext {
  ExchangeParts parts;
  Phases phases;                                    // their faults have no effect on the plant
  std::vector<AllowedAccess> allowed;               // by module
  std::vector<ConfiguredUses> configured;           // by module
  std::vector<std::filesystem::path> files;         // by module: that of the configuration, or of a later deployment
  std::map<std::uint32_t, ModuleLibrary> previous;  // by module; started and not stopped
  Retired retired;
  ScheduleChange* schedule = nullptr;  // connected before any command is accepted
  // Where the runs of a module are recorded; null: nowhere.
  [[nodiscard]] tape::Track* track_of(std::uint32_t module) const noexcept {
    return parts.tape == nullptr ? nullptr : parts.tape->of(module);
  }
  // The version may follow: its runs get its number, and the track the variables that it uses.
  void offer_to_track(std::uint32_t module, const ModuleLibrary& version) const;
  // The module does not run, and its next run is one of this version.
  void set_on_track(std::uint32_t module, const ModuleLibrary& version) const;
};

class ModuleExchange {
 public:
  // `held`: it is one of several. Its new version waits for enter(), and is watched until settle(); no answer is given.
  ModuleExchange(ExchangeContext& context, std::uint32_t module, bool held)
      : context_(context), module_(module), held_(held) {}

  // Begins an exchange with the version of the request, or with the previous one.
  void begin(const operate::ReloadRequest& request);
  void begin_back(scheduler::Exchange::Reason reason);
  // Continues it.
  void go_on(rt::MonoTime now);
  // The previous version is to run again. Returns at once.
  void go_back();
  // The schedule has ended: no run is in progress, and none will be exchanged.
  void end();

  // For those that are held. Lets the new version follow in the first run of this tick or after it.
  void enter(std::uint64_t tick) { watch(tick); }
  // Ends the time in which the previous version is ready.
  void settle();
  [[nodiscard]] bool is_ready() const noexcept { return step_ == Step::Ready; }
  [[nodiscard]] bool has_exchanged() const noexcept { return step_ == Step::Watched && !back_; }
  // Valid when it is over.
  [[nodiscard]] bool runs_new() const noexcept { return exchanged_ != back_; }
  [[nodiscard]] const operate::ReloadReport& report() const noexcept { return report_; }
  [[nodiscard]] std::optional<scheduler::CommandResult> result() const noexcept { return result_; }

  [[nodiscard]] bool is_over() const noexcept { return step_ == Step::Over; }
  // Returns true while the new version is loaded and started.
  [[nodiscard]] bool is_prepared() const noexcept { return step_ >= Step::Ready; }
  // Returns true if the new version runs, and the previous one is ready.
  [[nodiscard]] bool is_watched() const noexcept { return step_ == Step::Watched; }
  // Returns true while it is not settled which version of the module runs.
  [[nodiscard]] bool is_open() const noexcept;
  // Another command about it is under way.
  void await_answer() { result_.reset(); }

 private:
  enum class Step {
    Preparing,  // checked and loaded, on a thread of its own
    Starting,   // start() runs
    Ready,      // held: waits for its tick
    Waiting,    // for the run that is the first of the other version
    Watched,    // it runs; the previous version is ready
    Leaving,    // the run that may still ask the exchange is in progress
    Over,
  };

  void prepared();
  bool is_wanted(Candidate& candidate);
  void start_other();
  void started();
  void replace_closed();
  void watch(std::uint64_t tick);
  void wait_for_exchange();
  void offer_copy();
  void note_exchanged();
  void check_health();
  void save_for_return();
  void note_returned();
  void return_closed();
  void report_return(scheduler::Exchange::Reason reason);
  void leave();
  void has_left();
  void abort(const std::string& why);
  void answer(scheduler::CommandResult result, const std::string& text);
  void set_version(scheduler::VersionState state);
  void discard_other();
  [[nodiscard]] scheduler::ModuleRecord& record() const noexcept { return context_.parts.run.modules()[module_]; }
  [[nodiscard]] ModuleLibrary& running() const noexcept { return context_.parts.libraries[module_]; }

  ExchangeContext& context_;
  std::uint32_t module_;
  bool held_;
  Step step_ = Step::Preparing;
  bool back_ = false;  // to the previous version
  operate::ReloadRequest request_;
  operate::ReloadReport report_;
  std::optional<scheduler::CommandResult> result_;  // the answer; none: it was not given
  std::optional<GuardCondition> guard_;
  std::unique_ptr<CandidateThread> preparation_;
  Phases::CallPointer call_{nullptr, [](Phases::Call* /*none*/) {}};
  rt::MonoTime deadline_{};  // of this step, in the node's time
  ModuleLibrary other_;      // the version that does not run
  Carry carry_;
  VariableChange variables_;      // that the version which does not run brings
  std::vector<std::byte> saved_;  // what the running version kept in a gap, if a normal thread copies
  std::size_t saved_bytes_ = 0;
  std::unique_ptr<scheduler::Exchange> exchange_;
  std::uint64_t skipped_before_ = 0;
  std::uint64_t overruns_before_ = 0;
  bool exchanged_ = false;         // `other_` is the previous version
  bool other_is_unsound_ = false;  // it was left in the middle of a run
  std::string failure_;            // why the exchange was given up; empty: it was not
  std::optional<scheduler::Exchange::Reason> then_back_;
  scheduler::Exchange::Reason reason_ = scheduler::Exchange::Reason::Command;  // of `back_`
};

// First tick of the next macro period, in which modules that belong together meet; of a longer one than a second the
// next tick, because it is not waited for.
std::uint64_t next_macro_period(const ExchangeContext& context);

}  // namespace indurop::node
