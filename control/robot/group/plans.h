// SPDX-License-Identifier: Apache-2.0
// From commands to paths: what waits to be planned, what is being planned, and which plan the follower gets.

#pragma once

#include "control/robot/group/path_correction.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/shared_space.h"
#include "control/robot/group/ways_ahead.h"
#include "control/robot/plan/planning_desk.h"
#include "control/robot/plan/read_ahead.h"

namespace indurop::robot {

// MoveCommand::source of the motion with which a job goes on: the rest of its path, else `asked`, which was being
// planned (null: none), else the first one that waits; 0: none.
[[nodiscard]] int continued_source(const KeptPath& path, const PlanRequest* asked, const ReadAhead& ahead) noexcept;

class Plans {
 public:
  Plans(Robot& robot, const PathCorrection& correction, SharedSpace& space, WaysAhead& ways)
      : robot_(robot),
        correction_(correction),
        space_(space),
        ways_(ways),
        ahead_(robot.tool.places(), robot.parts.tool),
        desk_(robot.tool.places(), robot.parts.joints, robot.parts.tool, robot.parts.settings, space.grid()) {}

  // All functions are real-time safe. Returns whether nothing is being planned, and no plan waits.
  [[nodiscard]] bool free() const noexcept { return desk_.free() && waiting_ == nullptr; }
  [[nodiscard]] bool can_plan() const noexcept { return free() && robot_.follower.has_room(); }
  // Returns whether the thread still uses an abandoned request.
  [[nodiscard]] bool holds_forgotten() noexcept { return desk_.holds_forgotten(); }
  // Announces that plans will soon be requested.
  void expect_work(bool soon) noexcept { desk_.expect_work(soon); }
  [[nodiscard]] PlanningDesk& desk() noexcept { return desk_; }
  [[nodiscard]] const PlanningDesk& desk() const noexcept { return desk_; }
  // Motions that wait to be planned.
  [[nodiscard]] ReadAhead& ahead() noexcept { return ahead_; }
  [[nodiscard]] const ReadAhead& ahead() const noexcept { return ahead_; }

  // Requests a plan for a motion that begins where the last one ends.
  void ask(const PlanRequest& request) noexcept;
  // Requests the next motion that waits, which begins at `from`; requires can_plan(). `more`: others may be added in
  // this period. Returns what is being planned now.
  ReadAhead::Next begin_next(const Joints& from, bool more) noexcept;
  // Gives a plan that is ready to the follower, unless it failed or waits for space. Returns it; null: none is ready.
  const Plan* take() noexcept;
  // Abandons the plan in progress.
  void forget() noexcept {
    desk_.forget();
    waiting_ = nullptr;
  }

  [[nodiscard]] SharedSpace& space() noexcept { return space_; }
  // The last request; a job that is resumed has to make it again.
  [[nodiscard]] const PlanRequest& request() const noexcept { return request_; }
  void set_request(const PlanRequest& request) noexcept { request_ = request; }
  void ask_again() noexcept {
    request_.follows = false;
    ask(request_);
  }
  // The motion that was planned last is not the one that ends where the next one begins.
  void disconnect() noexcept { unconnected_ = true; }
  // MoveCommand::source of the motion that is followed, or will be next; 0: none.
  [[nodiscard]] int present_source() const noexcept;
  // MoveCommand::source of what begin_next() requested last.
  [[nodiscard]] int source() const noexcept { return source_; }

 private:
  Robot& robot_;
  const Plan* granted(const Plan& plan) noexcept;

  const PathCorrection& correction_;
  SharedSpace& space_;
  WaysAhead& ways_;
  ReadAhead ahead_;
  PlanningDesk desk_;
  PlanRequest request_;
  const Plan* waiting_ = nullptr;  // for space
  Plan refused_;                   // with the reason only
  bool unconnected_ = false;
  int source_ = 0;
};

}  // namespace indurop::robot
