// SPDX-License-Identifier: Apache-2.0
// The modules that another schedule adds to a running node: they are loaded next to those that run, get a place in the
// node, and are started; then the schedule may enter them. Processes are launched instead, and wait in
// irp::waitPeriod(); what runs in the background begins when the schedule counts. Called by the thread that supervises
// the node.

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "node/exchange/candidate_thread.h"
#include "node/exchange/exchanges.h"
#include "node/exchange/schedule_plan.h"
#include "node/modules/failsafe.h"
#include "node/modules/normal_threads.h"
#include "node/modules/processes.h"
#include "node/run/checked.h"
#include "node/run/console.h"
#include "scheduler/run_block_setup.h"
#include "store/operate/schedule_request.h"
#include "store/tape/tape.h"

namespace indurop::node {

class Arrivals {
 public:
  // The parts of the node needed for it, borrowed.
  struct Parts {
    config::Config& config;  // as the modules run
    scheduler::RunBlock& run;
    std::vector<ModuleLibrary>& libraries;
    scheduler::Engine& engine;
    vars::Store& store;
    FailSafe& failsafe;
    Exchanges& exchanges;
    Phases& phases;
    Processes& processes;
    NormalThreads& normal_threads;
    Console& console;
    tape::Tape* tape;  // null: none
  };

  explicit Arrivals(const Parts& parts) : parts_(parts) {}

  // Begins to load the added modules of a plan. `next` is borrowed until they have entered or are dropped.
  void begin(const Rechecked& next, const SchedulePlan& plan);
  // Continues. Returns true when all are loaded, or errors() says what is wrong.
  bool is_loaded();
  // Says in the report which variables they bring.
  void list_variables(operate::ScheduleReport& report) const;
  [[nodiscard]] const std::vector<std::string>& errors() const noexcept { return errors_; }
  // Returns true if a node that is started with them has none of the errors.
  [[nodiscard]] bool needs_restart() const noexcept { return needs_restart_; }
  // Gives those that are new a place, and completes the plan's indices. Returns false if there is no room: nothing has
  // changed.
  bool place(SchedulePlan& plan, const scheduler::RunBlockSetup& setup, const std::vector<scheduler::Task>& tasks);
  // Calls start() and launches processes, one after the other. Returns true when that is over, or failure() says why it
  // is not.
  bool is_started(rt::MonoTime now);
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }
  // Name of the module that cannot be loaded or started; empty: there is none.
  [[nodiscard]] const std::string& refused() const noexcept { return refused_; }
  // The schedule that has them may begin. Returns false if a process has ended meanwhile: failure() says why.
  bool enter();
  // It has begun.
  void settle();
  // They do not come. Returns those that have been started and have to be stopped.
  std::vector<std::uint32_t> drop();
  // The node ends: waits for a call in progress.
  void end();

 private:
  struct One {
    std::uint32_t place = 0;  // in the other configuration
    std::uint32_t index = SchedulePlan::kNoModule;
    bool is_process = false;
    bool is_in_background = false;
    bool loads = false;  // else it has ended, and its code is there
    std::string digest;  // of its file, if it loads
    ModuleLibrary library;
    VariableChange variables;  // that it brings
    bool begun = false;        // it has to be stopped if it does not come
    rt::MonoTime launched{};
  };
  [[nodiscard]] const config::Module& configured(const One& one) const { return next_->config.modules[one.place]; }
  [[nodiscard]] scheduler::ModuleRecord& record(const One& one) const { return parts_.run.modules()[one.index]; }
  void load_next();
  void offer(const One& one, const std::vector<scheduler::Task>& tasks);
  bool start(One& one, rt::MonoTime now);
  bool start_process(One& one, rt::MonoTime now);
  bool fail(const One& one, const std::string& why);
  void begin_in_background(const One& one);
  std::uint32_t add(One& one, const scheduler::ModuleSetup& setup);
  void replace_code(One& one);

  Parts parts_;
  const Rechecked* next_ = nullptr;
  std::vector<One> all_;
  std::vector<std::string> errors_;
  bool needs_restart_ = true;
  std::string refused_;
  std::size_t loaded_ = 0;
  std::size_t started_ = 0;
  std::string failure_;
  const ModuleLibrary none_;
  std::unique_ptr<CandidateThread> loading_;
  Phases::CallPointer call_{nullptr, [](Phases::Call* /*none*/) {}};
};

}  // namespace indurop::node
