// SPDX-License-Identifier: Apache-2.0
// From commands to paths: chooses what is planned next, and takes the plans.

#include <algorithm>
#include <cstdio>

#include "control/robot/group/group.h"

namespace indurop::robot {

Fault Group::move(const MoveCommand& command) noexcept {
  ahead_.add(command);
  return {};
}

// Requests a plan for a motion that begins where the last one ends.
void Group::ask_for_plan(const PlanRequest& request) noexcept {
  PlanRequest asked = request;
  asked.follows = asked.follows && follower_.goes_over() && !unconnected_;
  unconnected_ = false;
  desk_.ask(asked);
  request_ = asked;
  if (follower_.idle()) {
    follower_.reset(commanded());
    last_command_ = commanded();
  }
}

void Group::begin_next(bool more) noexcept {
  // Chains are few and reused, so none is begun while an abandoned one is still being checked.
  const bool leaving = shelf_->leaving;
  if (state_ != GroupState::Moving || leaving || !can_plan() || desk_.holds_forgotten()) {
    return;
  }
  const Joints from = planned_end();
  const ReadAhead::Next next = ahead_.next(from, more);
  if (next.chain != nullptr) {
    passed_known_ = 0;  // no step back is possible across it
    asked_ = next.chain->source_at(0);
    PlanRequest request{{}, next.chain, from, !follower_.idle()};
    request.command.ticket = next.ticket;
    request.command.acceleration = next.acceleration;
    ask_for_plan(request);
  } else if (next.command != nullptr) {
    asked_ = next.command->source;
    passed_[passed_count_++ % passed_.size()] = {*next.command, from};
    passed_known_ = asked_ < 0 ? 0 : std::min(passed_known_ + 1, passed_.size());
    ask_for_plan({*next.command, nullptr, from, !follower_.idle()});
  }
}

void Group::take_plan() noexcept {
  const Plan* plan = desk_.take();
  if (plan == nullptr) {
    return;
  }
  if (plan->fault.code == ErrorCode::Planner) {
    break_down("the thread that plans motions", desk_.crash());
  } else if (plan->fault.ok()) {
    follower_.add(plan->segment, plan->blend);
  } else {
    motion_failed(plan->fault, plan->segment.source, plan->segment.ticket);
  }
}

// The data that the thread wrote last may be corrupt, so the task ends: at rest, and without power. The tick has its
// own data.
void Group::break_down(const char* what, const char* how) noexcept {
  if (broken_[0] == '\0') {
    std::snprintf(broken_, sizeof broken_, "%s crashed: %s", what, how);
    trip(ErrorCode::Planner, 0, 1);
  }
}

void Group::report_break_down(Outputs& out) noexcept {
  constexpr double kMost = 1;  // s; a drive that is still on by then stays on
  const bool stands = broken_[0] != '\0' && state_ != GroupState::Stopping;
  const bool power =
      std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.drive().enabled(); });
  broken_for_ += stands ? period_ : 0;
  out.broken = stands && (!power || broken_for_ > kMost) ? broken_ : nullptr;
}

}  // namespace indurop::robot
