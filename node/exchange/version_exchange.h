// SPDX-License-Identifier: Apache-2.0
// The exchange of one module while the node runs: its new version is checked and prepared next to the running one,
// follows it between two runs, and is watched for a while. Of a thread (module_exchange.h) or of a process
// (process_exchange.h). Called by the thread that supervises the node.

#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "node/exchange/candidate.h"
#include "node/exchange/guard_condition.h"
#include "node/exchange/retired.h"
#include "node/modules/normal_threads.h"
#include "node/modules/processes.h"
#include "node/run/console.h"
#include "node/run/phases.h"
#include "scheduler/engine.h"
#include "scheduler/exchange.h"
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
  NormalThreads& normal_threads;
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
  // The variables only, as for a process.
  void offer_to_track(std::uint32_t module, const ModuleLibrary::Uses& uses) const;
  // The module does not run, and its next run is one of this version.
  void set_on_track(std::uint32_t module, const ModuleLibrary& version) const;
};

class VersionExchange {
 public:
  VersionExchange(const VersionExchange&) = delete;
  VersionExchange& operator=(const VersionExchange&) = delete;
  virtual ~VersionExchange() = default;

  // Begins an exchange with the version of the request.
  virtual void begin(const operate::ReloadRequest& request) = 0;
  // Continues it.
  virtual void go_on(rt::MonoTime now) = 0;
  // The previous version is to run again. Returns at once.
  virtual void go_back() = 0;
  // The schedule has ended: no run is in progress, and none will be exchanged.
  virtual void end() = 0;

  // For those that are held. Lets the new version follow in the first run of this tick or after it.
  virtual void enter(std::uint64_t tick) = 0;
  // Ends the time in which the previous version is ready.
  virtual void settle() = 0;
  [[nodiscard]] virtual bool is_ready() const noexcept = 0;
  [[nodiscard]] virtual bool has_exchanged() const noexcept = 0;
  // Valid when it is over.
  [[nodiscard]] virtual bool runs_new() const noexcept = 0;

  [[nodiscard]] virtual bool is_over() const noexcept = 0;
  // Returns true while the new version is loaded and started.
  [[nodiscard]] virtual bool is_prepared() const noexcept = 0;
  // Returns true if the new version runs, and the previous one is ready.
  [[nodiscard]] virtual bool is_watched() const noexcept = 0;
  // Returns true while it is not settled which version of the module runs.
  [[nodiscard]] virtual bool is_open() const noexcept = 0;

  [[nodiscard]] const operate::ReloadReport& report() const noexcept { return report_; }
  [[nodiscard]] std::optional<scheduler::CommandResult> result() const noexcept { return result_; }
  // Another command about it is under way.
  void await_answer() { result_.reset(); }

 protected:
  // `held`: it is one of several. Its new version waits for enter(), and is watched until settle(); no answer is given.
  VersionExchange(ExchangeContext& context, std::uint32_t module, bool held)
      : context_(context), module_(module), held_(held) {}

  static constexpr const char* kGivenUp = "the exchange was given up";
  static constexpr std::uint64_t kNotYet = std::numeric_limits<std::uint64_t>::max();  // as tick: enter() says when

  // Takes a request over. `running`: digest of the version that runs. Returns false if it was answered, because its
  // guard is none.
  bool accept(const operate::ReloadRequest& request, const std::string& running);
  // Reports which files are not there for replays.
  void note_not_kept(const Candidate& candidate) const;
  // The first answer to a command counts.
  void answer(scheduler::CommandResult result, const std::string& text);
  // Another version runs from now on, the one with this digest.
  void set_version(scheduler::VersionState state, const std::string& digest);
  // The same, when it is the previous one. The report comes first: a client that sees the version's state reads it.
  // `who`: "the previous one, runs".
  void report_return(scheduler::Exchange::Reason reason, const std::string& digest, const std::string& who);
  [[nodiscard]] scheduler::ModuleRecord& record() const noexcept { return context_.parts.run.modules()[module_]; }

  // NOLINTBEGIN(cppcoreguidelines-non-private-member-variables-in-classes,misc-non-private-member-variables-in-classes)
  ExchangeContext& context_;
  std::uint32_t module_;
  bool held_;
  operate::ReloadRequest request_;
  operate::ReloadReport report_;
  std::optional<GuardCondition> guard_;
  // NOLINTEND(cppcoreguidelines-non-private-member-variables-in-classes,misc-non-private-member-variables-in-classes)

 private:
  std::optional<scheduler::CommandResult> result_;  // the answer; none: it was not given
};

// First tick of the next macro period, in which modules that belong together meet; of a longer one than a second the
// next tick, because it is not waited for.
std::uint64_t next_macro_period(const ExchangeContext& context);

}  // namespace indurop::node
