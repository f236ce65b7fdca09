// SPDX-License-Identifier: Apache-2.0
// Exchanges the code of modules while the node runs, one at a time: a new version is checked, loaded and started next
// to the running one, follows it between two runs, and is watched for a while. Called by the thread that supervises the
// node.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "node/exchange/candidate.h"
#include "node/exchange/candidate_thread.h"
#include "node/exchange/guard_condition.h"
#include "node/exchange/retired.h"
#include "node/run/console.h"
#include "node/run/phases.h"
#include "scheduler/engine.h"
#include "scheduler/module_command.h"
#include "store/operate/reload.h"

namespace indurop::node {

class Exchanges {
 public:
  // The parts of the node needed for that, borrowed.
  struct Parts {
    const std::string& node;
    const config::Config& config;
    scheduler::RunBlock& run;
    std::vector<ModuleLibrary>& libraries;  // the versions that run
    scheduler::Engine& engine;
    vars::Store& store;
    Console& console;
    bool simulated = false;  // virtual time does not pass while a version is prepared
  };
  // `check`: as the node starts. `phases`: their faults have no effect on the plant.
  Exchanges(const Parts& parts, const config::CheckResult& check, Phases phases);
  ~Exchanges();
  Exchanges(const Exchanges&) = delete;
  Exchanges& operator=(const Exchanges&) = delete;

  // Accepts commands and continues the exchange in progress.
  void poll(rt::MonoTime now);
  // Called when the schedule has ended.
  void end();
  // Returns true while it is not settled which version of the module runs.
  [[nodiscard]] bool is_open(std::uint32_t module) const noexcept;

 private:
  enum class Step {
    Preparing,  // checked and loaded, on a thread of its own
    Starting,   // start() runs
    Waiting,    // for the run that is the first of the other version
    Watched,    // it runs; the previous version is ready
    Leaving,    // the run that may still ask the exchange is in progress
  };
  struct Work {
    std::uint32_t module = 0;
    Step step = Step::Preparing;
    bool back = false;  // to the previous version
    operate::ReloadRequest request;
    operate::ReloadReport report;
    std::optional<GuardCondition> guard;
    std::unique_ptr<CandidateThread> preparation;
    Phases::CallPointer call{nullptr, [](Phases::Call* /*none*/) {}};
    rt::MonoTime began{};     // of this step, real time
    rt::MonoTime deadline{};  // of this step, in the node's time
    ModuleLibrary other;      // the version that does not run
    Carry carry;
    std::vector<std::byte> saved;  // what the running version kept in a gap, if a normal thread copies
    std::size_t saved_bytes = 0;
    std::unique_ptr<scheduler::Exchange> exchange;
    std::uint64_t skipped_before = 0;
    std::uint64_t overruns_before = 0;
    bool exchanged = false;  // `other` is the previous version
    bool answered = false;
    bool other_is_unsound = false;  // it was left in the middle of a run
    std::string failure;            // why the exchange was given up; empty: it was not
    std::optional<scheduler::Exchange::Reason> then_back;
    scheduler::Exchange::Reason reason = scheduler::Exchange::Reason::Command;  // of `back`
  };

  void accept(std::uint32_t module, scheduler::ModuleCommand command);
  void accept_back(std::uint32_t module);
  void begin_back(std::uint32_t module, bool answered, scheduler::Exchange::Reason reason);
  void prepare(std::uint32_t module);
  void go_on(rt::MonoTime now);
  void prepared();
  bool is_wanted(Candidate& candidate);
  void start_other();
  void started(rt::MonoTime now);
  void replace_closed();
  void watch();
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
  void end_work();
  void abort(const std::string& why);
  void answer(scheduler::CommandResult result, const std::string& text);
  void answer_other(std::uint32_t module, scheduler::CommandResult result, const std::string& text);
  void set_version(scheduler::VersionState state);
  void discard_other();
  [[nodiscard]] std::string numbers() const;
  [[nodiscard]] scheduler::ModuleRecord& record(std::uint32_t module) const noexcept {
    return parts_.run.modules()[module];
  }
  [[nodiscard]] scheduler::ModuleRecord& record() const noexcept { return record(work_->module); }
  [[nodiscard]] ModuleLibrary& running() const noexcept { return parts_.libraries[work_->module]; }

  Parts parts_;
  Phases phases_;
  std::vector<AllowedAccess> allowed_;
  std::map<std::uint32_t, ModuleLibrary> previous_;  // by module; started and not stopped
  std::unique_ptr<Work> work_;                       // null: no exchange is in progress
  Retired retired_;
};

}  // namespace indurop::node
