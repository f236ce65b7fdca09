// SPDX-License-Identifier: Apache-2.0
// Another schedule takes over while the node runs: its configuration is checked as at the start, compared with what
// runs, built next to it, and counts from the begin of a macro period on. Called by the thread that supervises the
// node.

#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/rt/thread.h"
#include "node/exchange/arrivals.h"
#include "node/exchange/macro_grid.h"
#include "node/exchange/schedule_plan.h"
#include "node/parts/board_mirror.h"
#include "node/run/checked.h"
#include "node/run/console.h"
#include "node/run/setup.h"
#include "scheduler/engine.h"
#include "scheduler/module_command.h"
#include "store/operate/schedule_request.h"

namespace indurop::node {

class ScheduleChange {
 public:
  // The parts of the node needed for it, borrowed.
  struct Parts {
    const Options& options;
    config::Config& config;  // as the modules run
    scheduler::RunBlock& run;
    const std::vector<ModuleLibrary>& libraries;
    scheduler::Engine& engine;
    const vars::Store& store;
    Console& console;
    Placement placement;
    BoardRoutes& routes;
    BoardMirror& mirror;
  };

  ScheduleChange(const Parts& parts, const Arrivals::Parts& arrivals)
      : parts_(parts), arrivals_(arrivals), grid_{parts.run.slot_count, 0} {}
  ScheduleChange(const ScheduleChange&) = delete;
  ScheduleChange& operator=(const ScheduleChange&) = delete;
  ~ScheduleChange() = default;

  // Accepts a command and continues. `others`: what else is in progress, such as "module x is being exchanged"; the
  // schedule does not change meanwhile. Empty: nothing.
  void poll(rt::MonoTime now, const std::string& others);
  // Returns true while commands to modules have to wait.
  [[nodiscard]] bool is_switching() const noexcept { return step_ == Step::Building || step_ == Step::Waiting; }
  // A module that is to be stopped.
  struct Leaver {
    std::uint32_t module = 0;
    bool has_run = false;                  // else it was started for a schedule that has not taken over
    std::vector<std::uint32_t> followers;  // modules that the schedule has had since
  };
  // Returns each once.
  std::vector<Leaver> take_leavers();
  // Called when the schedule has ended.
  void end();
  // The ticks in which modules are exchanged, too.
  [[nodiscard]] MacroGrid grid() const;

  // For a deployment, which changes all boards at one tick: that schedule is prepared, and waits for the tick. No
  // answers are given. Ends with release().
  void hold(const std::string& manifest, bool compares);
  void release();
  struct Held {
    bool on = false;
    bool changes = false;   // another schedule follows: both differ
    bool counts = false;    // it has taken over
    bool given_up = false;  // the schedule before is to count
    std::string failure;    // why that one counts; empty: nothing has gone wrong
    bool needs_restart = false;
    std::string refused;  // name of an added module that cannot be loaded or started
    std::string before;   // manifest of the schedule before
  };
  [[nodiscard]] const Held& held() const noexcept { return held_; }
  // Returns true when it is ready, was only compared, changes nothing, or has failed.
  [[nodiscard]] bool is_prepared() const noexcept;
  [[nodiscard]] const operate::ScheduleReport& report() const noexcept { return report_; }
  // The ticks in which macro periods of both schedules begin.
  [[nodiscard]] MacroGrid common_with_next() const;
  // It takes over in this tick, or fails.
  void enter(std::uint64_t tick);
  // The schedule before is to count. Returns at once; it may have to take over again.
  void go_back();
  // From now on the board exchanges what either schedule, with the modules that follow, is to exchange with others.
  void open_routes();
  // Only one of the two counts.
  void settle_routes(bool keeps_next);
  [[nodiscard]] bool is_at_rest() const noexcept { return step_ == Step::Idle; }

 private:
  enum class Step {
    Idle,
    Checking,  // on a thread of its own
    Loading,   // modules that are added
    Starting,  // their start() runs
    Building,  // its threads start
    Ready,     // held: waits for its tick to be named
    Waiting,   // for its first tick
    Leaving,   // runs of the schedule before may be in progress
  };

  void accept(const std::string& others);
  void check(const operate::ScheduleRequest& request);
  void checked();
  void make_plan();
  void compare_routes();
  void loaded();
  void start(rt::MonoTime now, const std::string& others);
  void prepare(const std::string& others);
  void begin_waiting();
  bool propose(std::uint64_t step);
  [[nodiscard]] bool waits_for_tick() const noexcept { return held_.on && !request_.back; }
  bool is_given_up();
  void follow_held();
  void follow();
  void settle();
  void settle_module(std::size_t place, std::uint32_t index);
  void fail(const std::string& why);
  void refuse(const std::string& why);
  void answer(scheduler::CommandResult result, const std::string& text);
  void respond(operate::ScheduleReport report, scheduler::CommandResult result, const std::string& text) const;
  [[nodiscard]] scheduler::ModuleRecord& record(std::uint32_t module) const noexcept {
    return parts_.run.modules()[module];
  }

  Parts parts_;
  Step step_ = Step::Idle;
  operate::ScheduleRequest request_;
  operate::ScheduleReport report_;
  rt::Thread thread_;
  std::atomic<bool> is_checked_{false};
  Rechecked next_;
  SchedulePlan plan_;
  scheduler::RunBlockSetup setup_;      // of `next_`
  std::vector<scheduler::Task> tasks_;  // of `next_`, by the indices of the run block
  Arrivals arrivals_;
  bool waits_for_any_tick_ = false;  // in each macro period that began a run was in progress
  std::vector<Leaver> leavers_;
  std::optional<config::Config> previous_;  // of the schedule before
  MacroGrid grid_;                          // of macro periods
  MacroGrid next_grid_;                     // of those of `next_`
  Held held_;
};

}  // namespace indurop::node
