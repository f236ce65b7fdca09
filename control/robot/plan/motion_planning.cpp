// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/motion_planning.h"

namespace indurop::robot {

namespace {

constexpr int kPortion = 64;  // places, between two checks whether the plan is still needed

}  // namespace

Fault MotionPlanning::finish(Fault fault, const std::atomic<bool>& dropped) noexcept {
  while (fault.ok() && !planner_.done() && !dropped.load(std::memory_order_relaxed)) {
    fault = planner_.check(kPortion);
  }
  return fault;
}

void MotionPlanning::plan(const PlanRequest& request, const std::atomic<bool>& dropped, Plan& plan) noexcept {
  planner_.spare(request.reserve);
  plan.blend = {};
  plan.cut = nullptr;
  plan.parts = false;
  if (request.chain != nullptr) {
    plan.fault = finish(
        planner_.begin(*request.chain, request.from, request.command.acceleration, request.command.wave), dropped);
    plan.segment = planner_.segment();
    plan.parts = request.lines != nullptr && parts(*request.lines, request, dropped, plan);
  }
  if (request.joint_path != nullptr) {
    plan.fault = finish(planner_.begin(request.command, *request.joint_path, request.from), dropped);
    plan.segment = planner_.segment();
  } else if (request.chain == nullptr || plan.parts) {
    plan_one(request, dropped, plan);
  }
  plan.segment.ticket = request.lines != nullptr && !plan.parts ? 0 : request.command.ticket;
  if (plan.fault.ok() && !dropped.load(std::memory_order_relaxed)) {
    if (request.follows) {
      plan.blend = planner_.blend(before_, plan.segment);
    }
    plan.segment.cells = request.cells;
    plan.segment.sync = request.command.sync;
    if (request.cells != nullptr) {
      sweep_.sweep(plan.segment, dropped, *request.cells);
      if (plan.blend.zone > 0) {
        sweep_.add(before_, plan.blend, plan.segment, dropped, *request.cells);
      }
    }
    sample_way(request, plan);
    before_ = plan.segment;
  }
}

void MotionPlanning::sample_way(const PlanRequest& request, Plan& plan) noexcept {
  plan.segment.way_ahead = nullptr;
  if (request.way == nullptr || (plan.blend.zone > 0 && request.cut == nullptr)) {
    return;
  }
  way_.sample(before_, plan.blend, plan.segment, request.cut, *request.way);
  plan.segment.way_ahead = request.way;
  plan.cut = plan.blend.zone > 0 && request.cut->count > 0 ? request.cut : nullptr;
}

void MotionPlanning::plan_one(const PlanRequest& request, const std::atomic<bool>& dropped, Plan& plan) noexcept {
  MoveCommand command = request.command;
  command.zone = 0;
  plan.fault = finish(planner_.begin(command, request.from), dropped);
  plan.segment = planner_.segment();
  Segment rounding;
  if (plan.fault.ok() && request.command.zone > 0 && request.leads &&
      zone_helps(request, dropped, plan.segment, rounding)) {
    plan.segment = rounding;
  }
}

// What is entered by a blend has one speed in any case.
bool MotionPlanning::zone_helps(const PlanRequest& request, const std::atomic<bool>& dropped, const Segment& stopping,
                                Segment& rounding) noexcept {
  if (!finish(planner_.begin(request.command, request.from), dropped).ok()) {
    return false;
  }
  rounding = planner_.segment();
  MoveCommand then = request.then;
  then.zone = 0;
  if (!finish(planner_.begin(then, rounding.to), dropped).ok()) {
    return false;
  }
  const Segment next = planner_.segment();
  const Blend blend = planner_.blend(rounding, next);
  const bool entered = request.follows && planner_.blend(before_, rounding).zone > 0;
  return blend.zone > 0 &&
         duration(rounding, blend, next) < (entered ? rounding.duration() : from_rest(stopping)) + from_rest(next);
}

double MotionPlanning::from_rest(const Segment& segment) const noexcept {
  if (!segment.together) {
    return segment.duration();
  }
  Segment motion = segment;
  motion.take_joint_timing({segment.from, Joints::Zero(), Joints::Zero()}, joints_, 1);
  return motion.length;
}

// A line that fails, or whose end is out of reach, is reported when it is its turn. Between crowded lines the arm would
// stop everywhere.
bool MotionPlanning::parts(const Chain& lines, const PlanRequest& request, const std::atomic<bool>& dropped,
                           const Plan& joined) noexcept {
  if (!joined.fault.ok()) {
    return !lines.crowded();
  }
  const double seconds = joined.segment.duration();
  double least = 0;
  for (int i = 0; i < lines.count(); ++i) {
    least += lines.least_time(i);
  }
  Joints from = request.from;
  for (int i = 0; i < lines.count() && least < seconds; ++i) {
    MoveCommand line = lines.line(i);
    line.acceleration = request.command.acceleration;
    if (!finish(planner_.begin(line, from), dropped).ok() || !planner_.done()) {
      return false;
    }
    from = planner_.segment().to;
    least += planner_.segment().duration() - lines.least_time(i);
  }
  return least < seconds;
}

}  // namespace indurop::robot
