// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/path_geometry.h"

#include <algorithm>
#include <cmath>

#include "control/robot/path/arc.h"
#include "control/robot/path/rates.h"

namespace indurop::robot {

namespace {

constexpr double kSlowestMotion = 1e-9;  // m/s, and parts of full speed: below it counts as no motion
constexpr double kSamePlace = 1e-6;      // rad or m
constexpr double kCornerFactor = 4;      // how much faster the speed along a corner may change than on a straight piece

bool finite(const Target& target) noexcept {
  return target.joints.allFinite() && target.pose.position.allFinite() && target.pose.orientation.coeffs().allFinite();
}

bool in_range(const MoveCommand& command) noexcept {
  return command.speed >= kSlowestMotion && command.speed <= 1 &&
         (command.tool_speed == 0 || command.tool_speed >= kSlowestMotion) && command.zone >= 0 &&
         command.acceleration >= kSlowestMotion && command.acceleration <= 1;
}

// Searches for an arm without a closed form if no solutions are known: next to a point, or for a pose given by a
// command. An axis that the pose leaves undetermined stays where it is, if that is possible and no axis gets close to a
// limit. One that moves the workpiece moves only if the target says so.
Inverse::Result search(const Places& places, const Target& target, const Joints& near, PlanningWork& work) noexcept {
  const Inverse& inverse = places.inverse();
  if (inverse.held() != 0 && target.held == 0) {
    constexpr int kPlaces = 100;
    work.add(kPlaces);
    if (const Inverse::Result one = inverse.reach(target.pose, near); one.reach == Reach::Ok) {
      return one;
    }
  }
  Search how{32, 96};
  const Held workpiece = workpiece_axes(places.arm());
  how.held = target.held != 0 ? target.held | workpiece : redundant_axes(places.arm());
  const Joints from = target.held != 0 ? with_axes(workpiece & ~target.held, near, target.joints) : near;
  Solutions found = inverse.search(target.pose, from, how);
  work.add(how.most);
  if (found.count == 0 && target.held == 0 && how.held != workpiece) {
    how.held = workpiece;
    found = inverse.search(target.pose, from, how);
    work.add(how.most);
  }
  if (found.count == 0) {
    return {found.reach, {}};
  }
  return inverse.nearest(found, near, target.posture);
}

// Determines the joint angles and the pose at the end.
Fault resolve(const Places& places, const MoveCommand& command, Draft& draft) noexcept {
  Segment& s = draft.segment;
  const Target& target = command.target;
  if (!finite(target)) {
    return {ErrorCode::Value};
  }
  if (!target.is_pose) {
    s.to = target.joints;
    s.end = places.arm().forward(s.to);
    const int beyond = places.arm().beyond_limits(s.to);
    return {beyond < 0 ? ErrorCode::Ok : ErrorCode::JointLimit, beyond + 1};
  }
  s.end = target.pose;
  const Joints held = with_axes(target.held, target.joints, s.from);
  if (const int beyond = target.held == 0 ? -1 : places.arm().goes_beyond(s.from, held, 1e-9); beyond >= 0) {
    return {ErrorCode::JointLimit, beyond + 1};
  }
  const Inverse& inverse = places.inverse();
  if (command.move != Move::Joint && !inverse.closed_form()) {
    return {};  // a path that is followed from place to place reaches its end anyway
  }
  const auto found = target.known != nullptr ? inverse.nearest(*target.known, s.from, target.posture)
                     : inverse.closed_form() ? inverse.nearest(s.end, held, target.posture)
                                             : search(places, target, s.from, draft.work);
  s.to = found.solution.q;
  return {code_of(found.reach)};
}

Fault make_circle(const Vec3& mid, Segment& s) noexcept {
  Arc arc;
  if (!arc.through(s.start.position, mid, s.end.position)) {
    return {ErrorCode::Circle};
  }
  s.center = arc.center;
  s.radius_x = arc.radius_x;
  s.radius_y = arc.radius_y;
  s.angle = arc.angle;
  s.way = arc.way();
  return {};
}

void measure_joint_motion(const Arm& arm, double speed, Draft& draft) noexcept {
  Segment& s = draft.segment;
  const Joints change = s.to - s.from;
  s.length = change.cwiseAbs().cwiseQuotient(draft.joints.velocity).maxCoeff();
  if (s.length <= 0) {
    return;
  }
  s.speed = speed;
  s.limits = {speed, HUGE_VAL, HUGE_VAL};
  for (int i = 0; i < kAxes; ++i) {
    const double rate = std::abs(change[i]) / s.length;
    s.limits.acceleration = std::min(s.limits.acceleration, shared(draft.joints.acceleration[i], rate));
    s.limits.jerk = std::min(s.limits.jerk, shared(draft.joints.jerk[i], rate));
  }
  constexpr int kPlaces = 64;
  TipSpeed tip(arm);
  tip.begin(s.from);
  for (int i = 1; i <= kPlaces; ++i) {
    tip.note(s.joints_at(s.length * i / kPlaces));
  }
  s.tip_speed = tip.farthest() * kPlaces / s.length;
}

// The axes that the pose leaves undetermined and the target does not.
Fault aim_elbow(const Places& places, const Target& target, Draft& draft) noexcept {
  Segment& s = draft.segment;
  const Held held = target.held & places.inverse().held();
  draft.elbow_given = held != 0;
  s.elbow = s.from;
  for (int i = 0; i < places.arm().count() && held != 0; ++i) {
    if (holds(held, i)) {
      s.elbow[i] = target.joints[i];
      s.elbow_moves = s.elbow_moves || s.elbow[i] != s.from[i];
    }
  }
  const int beyond = held == 0 ? -1 : places.arm().beyond_limits(s.elbow);
  return {beyond < 0 ? ErrorCode::Ok : ErrorCode::JointLimit, beyond + 1};
}

// m of the tool's tip in the world per part of a motion that keeps its place on the workpiece, while that turns.
double farthest_in_world(const Arm& arm, const Segment& s) noexcept {
  constexpr int kPlaces = 64;
  double farthest = 0;
  Vec3 last = Vec3::Zero();
  for (int i = 0; i <= kPlaces; ++i) {
    const ChainFrame world = arm.world(s.from + (s.elbow - s.from) * i / kPlaces);
    const Vec3 here = world.turn.transpose() * (s.start.position - world.shift);
    farthest = i == 0 ? 0 : std::max(farthest, (here - last).norm());
    last = here;
  }
  return kPlaces * farthest;
}

void measure_tool_motion(const Arm& arm, const MoveCommand& command, Draft& draft) noexcept {
  Segment& s = draft.segment;
  const ToolLimits& tool = draft.tool;
  s.turn = rotation_between(s.start.orientation, s.end.orientation);
  const double angle = s.turn.norm();
  s.length = std::max(s.way / tool.velocity, angle / tool.turn_velocity);
  const Joints elbow = s.elbow_moves ? Joints((s.elbow - s.from).cwiseAbs()) : Joints(Joints::Zero());
  if (s.elbow_moves) {
    s.length = std::max(s.length, elbow.cwiseQuotient(draft.joints.velocity).maxCoeff());
  }
  if (s.length <= 1e-9) {
    s.length = 0;
    s.to = s.from;  // the joint angles of the target may be another posture
    return;
  }
  const double pace = s.way / s.length;
  const double turning = angle / s.length;
  s.limits.velocity = command.speed;
  if (command.tool_speed > 0) {
    const bool rests = s.elbow_moves && s.way < kSamePlace;
    s.limits.velocity = std::min(1.0, shared(command.tool_speed, rests ? farthest_in_world(arm, s) / s.length : pace));
  }
  double acceleration = tool.acceleration;
  if (s.move == Move::Circle) {
    // Half of the acceleration holds the tool on the circle.
    const double bend = pace * pace / s.radius_x.norm();
    s.limits.velocity = std::min(s.limits.velocity, std::sqrt(shared(acceleration / 2, bend)));
    acceleration /= 2;
  }
  s.limits.acceleration = std::min(shared(acceleration, pace), shared(tool.turn_acceleration, turning));
  s.limits.jerk = std::min(shared(tool.jerk, pace), shared(tool.turn_jerk, turning));
  for (int i = 0; i < kAxes && s.elbow_moves; ++i) {
    s.limits.acceleration = std::min(s.limits.acceleration, shared(draft.joints.acceleration[i], elbow[i] / s.length));
    s.limits.jerk = std::min(s.limits.jerk, shared(draft.joints.jerk[i], elbow[i] / s.length));
  }
  s.most = s.limits;
}

}  // namespace

Fault find_goals(const Places& places, const MoveCommand& command, Draft& draft, Solutions& goals) noexcept {
  Segment& s = draft.segment;
  s.move = Move::Joint;
  s.source = command.source;
  if (!in_range(command) || !s.from.allFinite()) {
    return {ErrorCode::Value};
  }
  MoveCommand joints = command;
  joints.move = Move::Joint;
  if (const Fault fault = resolve(places, joints, draft); !fault.ok()) {
    return fault;
  }
  goals.count = 0;
  goals.list[at(goals.count++)].q = s.to;
  const Target& target = command.target;
  if (!target.is_pose || target.posture || target.held != 0) {
    return {};
  }
  const Inverse& inverse = places.inverse();
  const Solutions all = target.known != nullptr ? *target.known : inverse.all(target.pose, s.to);
  for (int i = 0; i < all.count && goals.count < static_cast<int>(goals.list.size()); ++i) {
    const Joints& q = all.list[at(i)].q;
    if (places.arm().beyond_limits(q) < 0 && (q - s.to).cwiseAbs().maxCoeff() > kSamePlace) {
      goals.list[at(goals.count++)].q = q;
    }
  }
  const auto nearer = [&](const Solution& a, const Solution& b) {
    return (a.q - s.from).squaredNorm() < (b.q - s.from).squaredNorm();
  };
  std::sort(goals.list.begin() + 1, goals.list.begin() + goals.count, nearer);
  return {};
}

double arc_way(const Vec3& start, const Vec3& mid, const Vec3& end) noexcept {
  Arc arc;
  return arc.through(start, mid, end) ? arc.way() : 0;
}

void make_path(const Places& places, const MoveCommand& command, const JointPath& path, Draft& draft) noexcept {
  Segment& s = draft.segment;
  s.to = path.end();
  s.end = places.arm().forward(s.to);
  s.length = path.length();
  if (s.length <= 0) {
    return;
  }
  s.move = Move::Free;
  s.joint_path = &path;
  const Joints fastest = path.fastest();
  s.limits = {command.speed, HUGE_VAL, HUGE_VAL};
  s.most = {command.speed, 0, 0};
  for (int i = 0; i < kAxes; ++i) {
    s.limits.acceleration = std::min(s.limits.acceleration, shared(draft.joints.acceleration[i], fastest[i]));
    s.limits.jerk = std::min(s.limits.jerk, shared(draft.joints.jerk[i], fastest[i]));
    // The axis that is at its full speed sets these on a straight piece; on a corner all axes may be slower.
    s.most.acceleration =
        std::max(s.most.acceleration, kCornerFactor * draft.joints.acceleration[i] / draft.joints.velocity[i]);
    s.most.jerk = std::max(s.most.jerk, kCornerFactor * draft.joints.jerk[i] / draft.joints.velocity[i]);
  }
}

Fault make_path(const Places& places, const MoveCommand& command, Draft& draft) noexcept {
  Segment& s = draft.segment;
  s.move = command.move;
  s.zone = command.zone;
  s.source = command.source;
  if (!in_range(command) || !s.from.allFinite()) {
    return {ErrorCode::Value};
  }
  if (const Fault fault = resolve(places, command, draft); !fault.ok()) {
    return fault;
  }
  if (command.move == Move::Joint) {
    measure_joint_motion(places.arm(), command.speed, draft);
    s.together = s.length > 0 && command.zone <= 0 && !command.straight;
    return {};
  }
  if (command.move == Move::Circle) {
    if (!finite(command.mid)) {
      return {ErrorCode::Value};
    }
    const Pose mid = command.mid.is_pose ? command.mid.pose : places.arm().forward(command.mid.joints);
    if (const Fault fault = make_circle(mid.position, s); !fault.ok()) {
      return fault;
    }
  } else {
    s.way = (s.end.position - s.start.position).norm();
  }
  if (const Fault fault = aim_elbow(places, command.target, draft); !fault.ok()) {
    return fault;
  }
  measure_tool_motion(places.arm(), command, draft);
  return {};
}

Fault make_path(const ToolPath& chain, Draft& draft) noexcept {
  Segment& s = draft.segment;
  s.move = Move::Line;
  s.chain = &chain;
  s.most = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  s.end = chain.end();
  s.way = chain.way();
  s.length = chain.length();
  s.source = chain.source_at(0);
  if (!s.from.allFinite() || !std::isfinite(s.length) || s.length <= 0) {
    return {ErrorCode::Value};
  }
  s.limits = chain.limits_at(0);
  return {};
}

}  // namespace indurop::robot
