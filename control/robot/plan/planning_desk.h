// SPDX-License-Identifier: Apache-2.0
// Plans motions, in a background thread or in the tick. The tick requests a plan, polls for it in each period, and
// never waits. A plan is due a fixed number of periods after the request, however soon it is ready, so that a motion
// begins in the same period on every run.

#pragma once

#include <indurop/robot/controller.h>
#include <pthread.h>

#include <atomic>
#include <chrono>
#include <cmath>

#include "control/robot/plan/motion_planning.h"

namespace indurop::robot {

class PlanningDesk {
 public:
  // `grid`: as for PathSweep.
  PlanningDesk(const Places& places, const JointLimits& joints, const ToolLimits& tool, const Settings& settings,
               const CellGrid* grid = nullptr);
  PlanningDesk(const PlanningDesk&) = delete;
  PlanningDesk& operator=(const PlanningDesk&) = delete;
  ~PlanningDesk();

  // Called by the tick, real-time safe: no system call, no lock. Returns whether nothing is being planned.
  [[nodiscard]] bool free() const noexcept { return !asked_; }
  // Returns whether the thread still uses an abandoned request: its chain must not be changed.
  [[nodiscard]] bool holds_forgotten() noexcept;
  // Returns whether the planning thread has nothing to do: then plans and requests do not change between two periods.
  // Called by any thread.
  [[nodiscard]] bool at_rest() const noexcept {
    const State state = state_.load(std::memory_order_acquire);
    return state == State::Free || state == State::Made;
  }
  // Requests a plan; requires free().
  void ask(const PlanRequest& request) noexcept;
  // Abandons the plan in progress; no motion will follow on it.
  void forget() noexcept;
  // Called once per period. Returns the plan if it is due and ready, or if the time for a search is up (NoWay); it
  // remains valid until the next request.
  const Plan* take() noexcept;
  // The planner, for replacing its bodies; requires free() and no abandoned request in use.
  [[nodiscard]] Planner& planner() noexcept { return planning_.planner(); }
  // Returns whether a plan, or one that was abandoned, uses these cells or this way.
  [[nodiscard]] bool uses(const SpaceCells* cells) const noexcept {
    return (asked_ && waiting_.cells == cells) || request_.cells == cells;
  }
  [[nodiscard]] bool uses(const ToolWay* way) const noexcept {
    const auto has = [way](const PlanRequest& request) { return request.way == way || request.cut == way; };
    return (asked_ && has(waiting_)) || has(request_);
  }
  // Announces that plans will soon be requested.
  void expect_work(bool soon) noexcept { soon_.store(soon, std::memory_order_relaxed); }
  // For a plan with ErrorCode::Planner: how the thread crashed.
  [[nodiscard]] const char* crash() const noexcept { return crash_; }

 private:
  // The owner of the request and the plan: the tick in Free, Asked and Made; the planning thread in Working.
  enum class State { Free, Asked, Working, Made };

  [[nodiscard]] bool learned(bool what) const noexcept { return learned_ != nullptr ? learned_(what) : what; }
  [[nodiscard]] double seconds_of(const PlanRequest& request) const noexcept;
  void post() noexcept;
  // Ends the search for a way that takes too long.
  const Plan* give_up() noexcept;
  void work() noexcept;
  void run() noexcept;
  void look_for_work() noexcept;
  static void* enter(void* desk) noexcept;

  const Places& places_;
  ToolLimits tool_;
  double period_ = 0;  // s
  double due_ = 0;     // periods
  bool in_tick_;
  bool (*learned_)(bool what) noexcept;
  decltype(Settings::guarded) guarded_;

  // Used by the tick only.
  bool asked_ = false;
  bool waits_ = false;   // for the thread to end an abandoned request
  bool forgot_ = false;  // an abandoned request that the thread may still use
  int periods_left_ = 0;
  double patience_ = HUGE_VAL;  // periods, after which a motion that is not planned is not possible
  PlanRequest waiting_;
  Plan given_up_;  // with the reason only

  std::atomic<State> state_{State::Free};
  std::atomic<bool> dropped_{false}, ending_{false}, soon_{false};
  PlanRequest request_;
  Plan plan_;

  // Used by the planning thread only.
  MotionPlanning planning_;
  bool crashed_ = false;  // it plans no more motions
  char crash_[96] = "";
  pthread_t thread_{};
};

}  // namespace indurop::robot
