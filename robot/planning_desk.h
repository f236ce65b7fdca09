// SPDX-License-Identifier: Apache-2.0
// Where motions are planned: by a thread beside the tick, or in it. The tick asks for a plan, looks for it in each
// period, and never waits. A plan is due a number of periods after it was asked for, however soon it is made, so that a
// motion begins in the same period on every run.

#pragma once

#include <indurop/robot/controller.h>
#include <pthread.h>

#include <atomic>
#include <chrono>

#include "robot/planner.h"

namespace indurop::robot {

struct PlanRequest {
  MoveCommand command;
  const ToolPath* chain = nullptr;  // instead of it; stays as it is until the motion has ended
  Joints from = Joints::Zero();
  bool follows = false;  // on the motion that was planned before, without a stop
};

struct Plan {
  Fault fault;
  Segment segment;  // if it failed only its source counts
  Blend blend;      // from the motion before into this one
};

class PlanningDesk {
 public:
  PlanningDesk(const Places& places, const JointLimits& joints, const ToolLimits& tool, const Settings& settings);
  PlanningDesk(const PlanningDesk&) = delete;
  PlanningDesk& operator=(const PlanningDesk&) = delete;
  ~PlanningDesk();

  // Of the tick, real-time safe: no system call, no lock. Nothing is being planned.
  [[nodiscard]] bool free() const noexcept { return !asked_; }
  // The thread has not let go of what was forgotten: its chain must stay as it is.
  [[nodiscard]] bool holds_forgotten() noexcept;
  // It is free.
  void ask(const PlanRequest& request) noexcept;
  // What is being planned is not wanted any more, and nothing follows on it.
  void forget() noexcept;
  // Once per period. The plan, if it is due and made; it stays until the next one is asked for.
  const Plan* take() noexcept;
  // For other bodies. It is free and holds nothing that was forgotten.
  [[nodiscard]] Planner& planner() noexcept { return planner_; }
  // Plans are soon to be asked for.
  void expect_work(bool soon) noexcept { soon_.store(soon, std::memory_order_relaxed); }
  // Of a plan with ErrorCode::Planner: how the thread crashed.
  [[nodiscard]] const char* crash() const noexcept { return crash_; }

 private:
  // What the request and the plan are: the tick's in Free, Asked and Made; the planning thread's in Working.
  enum class State { Free, Asked, Working, Made };

  [[nodiscard]] bool learned(bool what) const noexcept { return learned_ != nullptr ? learned_(what) : what; }
  [[nodiscard]] double seconds_of(const PlanRequest& request) const noexcept;
  void post() noexcept;
  void work() noexcept;
  void run() noexcept;
  void look_for_work() noexcept;
  static void* enter(void* desk) noexcept;

  const Places& places_;
  ToolLimits tool_;
  double due_ = 0;  // periods
  bool in_tick_;
  bool (*learned_)(bool what) noexcept;
  decltype(Settings::guarded) guarded_;

  // The tick's.
  bool asked_ = false;
  bool waits_ = false;   // for the thread to end what was forgotten
  bool forgot_ = false;  // something that the thread may not have let go of yet
  int periods_left_ = 0;
  PlanRequest waiting_;

  std::atomic<State> state_{State::Free};
  std::atomic<bool> dropped_{false}, ending_{false}, soon_{false};
  PlanRequest request_;
  Plan plan_;

  // The planning thread's.
  Planner planner_;
  Segment before_;
  bool crashed_ = false;  // it plans nothing more
  char crash_[96] = "";
  pthread_t thread_{};
};

}  // namespace indurop::robot
