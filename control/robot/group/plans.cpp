// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/plans.h"

namespace indurop::robot {

namespace {

// Returns whether the next segment may begin without a stop.
bool goes_over(const PathPieces& path) noexcept {
  return path.count > 0 && path.segments[at(path.count - 1)].zone > 0;
}

int source_of(const PlanRequest& request) noexcept {
  return request.chain != nullptr ? request.chain->source_at(0) : request.command.source;
}

}  // namespace

int continued_source(const KeptPath& path, const PlanRequest* asked, const ReadAhead& ahead) noexcept {
  if (path.known()) {
    return path.source();
  }
  return asked != nullptr ? source_of(*asked) : ahead.source();
}

int Plans::present_source() const noexcept {
  if (!robot_.follower.idle()) {
    return robot_.follower.source();
  }
  return free() ? ahead_.source() : source_of(request_);
}

void Plans::ask(const PlanRequest& request) noexcept {
  PlanRequest asked = request;
  asked.follows = asked.follows && goes_over(robot_.follower.path().pieces()) && !unconnected_;
  asked.reserve = correction_.shifts() ? PathCorrection::kReserve : 0;
  asked.cells = request.unreserved ? nullptr : space_.cells_for_plan(desk_);
  asked.way = ways_.for_plan(desk_);
  asked.cut = asked.way != nullptr && asked.follows ? ways_.for_plan(desk_, asked.way) : nullptr;
  unconnected_ = false;
  desk_.ask(asked);
  request_ = asked;
  if (robot_.follower.idle() && !correction_.shifts()) {
    robot_.stand_here();
  }
}

ReadAhead::Next Plans::begin_next(const Joints& from, bool more) noexcept {
  const ReadAhead::Next next = ahead_.next(from, more);
  const bool follows = !robot_.follower.idle();
  if (next.chain != nullptr) {
    source_ = next.chain->source_at(0);
    PlanRequest request{{}, next.chain, from, follows, next.lines};
    request.command.ticket = next.ticket;
    if (next.lines != nullptr) {
      request.command = *next.command;
      request.command.zone = 0;
    }
    request.command.acceleration = next.acceleration;
    request.command.wave = next.wave;
    ask(request);
  } else if (next.command != nullptr) {
    source_ = next.command->source;
    PlanRequest request{*next.command, nullptr, from, follows};
    request.leads = next.then != nullptr;
    if (request.leads) {
      request.then = *next.then;
    }
    request.joint_path = next.joint_path;
    ask(request);
  }
  return next;
}

const Plan* Plans::take() noexcept {
  const Plan* plan = waiting_ != nullptr ? waiting_ : desk_.take();
  if (plan == nullptr || !plan->fault.ok()) {
    return plan;
  }
  plan = granted(*plan);
  if (plan == nullptr || !plan->fault.ok()) {
    return plan;
  }
  if (plan->cut != nullptr) {
    robot_.follower.set_way(plan->cut);
  }
  robot_.follower.add(plan->segment, plan->blend);
  if (plan->parts) {
    ahead_.parted();
  } else if (plan->segment.chain != nullptr) {
    ahead_.joined();
  }
  return plan;
}

// Returns the plan; null: it waits; or a plan with the reason why it is refused.
const Plan* Plans::granted(const Plan& plan) noexcept {
  waiting_ = nullptr;
  if (plan.segment.cells == nullptr) {
    return &plan;
  }
  SharedSpace::Answer answer = space_.request(plan.segment.cells);
  if (answer == SharedSpace::Answer::Granted && plan.segment.sync >= 0) {
    answer = space_.meet(plan.segment.cells, robot_.parts.book.syncs[at(plan.segment.sync)].name);
  }
  switch (answer) {
    case SharedSpace::Answer::Granted:
      return &plan;
    case SharedSpace::Answer::Waits:
      waiting_ = &plan;
      return nullptr;
    case SharedSpace::Answer::Deadlock:
    case SharedSpace::Answer::Mismatch:
      refused_.fault = {ErrorCode::OtherRobot};
      refused_.segment.source = plan.segment.source;
      refused_.segment.ticket = plan.segment.ticket;
      return &refused_;
  }
  return nullptr;
}

}  // namespace indurop::robot
