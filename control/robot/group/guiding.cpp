// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/guiding.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "control/robot/group/last_gate.h"
#include "control/robot/group/mode_guard.h"
#include "control/robot/kinematics/settings.h"
#include "control/robot/kinematics/tip_speed.h"
#include "control/robot/path/rates.h"

namespace indurop::robot {

namespace {

constexpr double kGuidedSpeed = 0.9 * kReducedSpeed;  // m/s of the tip and of the arm's end
constexpr double kUsualThreshold = 0.02;              // of the rated torque, if none is given
constexpr double kWeighTime = 0.4;                    // s at rest before it begins
constexpr double kHandLever = 0.15;                   // m, the least lever of a hand
constexpr double kDrySpeed = 0.01;    // rad/s or m/s: below this, dry friction may act in either direction
constexpr double kWallTime = 0.5;     // s: an axis near its end is no faster than the way left in this time
constexpr double kWallMargin = 1e-3;  // rad or m, before the end of an axis
constexpr double kGuidedPart = 0.9;   // of an axis
constexpr const char* kNoTorque =
    "guiding by hand needs masses in the URDF, the property rated_torque, and drives that report their torques (6077h)";
constexpr double kRefusedPace = 0.7;  // where set points were refused
constexpr double kLeastPace = 0.02;
constexpr double kPaceTime = 1;  // s, until the full speed is back

Joints hand_thresholds(const Settings& settings) noexcept {
  const std::vector<double>& given = settings.guide_threshold;
  return given.empty() ? Joints(kUsualThreshold * of_axes(settings.rated_torque)) : of_axes(given);
}

// How far a push at the arm's end is from each axis; for sliding ones 1.
Joints hand_levers(const Jacobian& end, int count) noexcept {
  Joints lever = Joints::Ones();
  for (int i = 0; i < count; ++i) {
    lever[i] = std::max(end.col(i).head<3>().norm(), kHandLever);
  }
  return lever;
}

}  // namespace

Guiding::Guiding(Robot& robot, GroupPort& group, TorqueWatch& torques) noexcept
    : robot_(robot), group_(group), torques_(torques), threshold_(hand_thresholds(robot.parts.settings)) {}

void Guiding::step(const Inputs& in, const ModeGuard& mode) noexcept {
  const JogRequest& jog = in.jog;
  const bool held = enabling_switch_.holds(jog.enabled && jog.frame == JogFrame::Hand, jog.beat, robot_.period);
  const double override_part = in.speed_override / 100 * in.factors.group;
  part_ = in.hold || !std::isfinite(override_part) ? 0 : std::clamp(override_part, 0.0, 1.0);
  on_ = on_ && robot_.states.moving();
  blocked_ = blocked_ && held;
  wanted_ = held && mode.permits_guiding() && !blocked_;
  if (on_) {
    return;
  }
  if (held && !blocked_ && robot_.states.is(GroupState::Standby)) {
    if (const Fault fault = may_begin(mode); !fault.ok()) {
      refuse(fault, fault.code == ErrorCode::NoTorque ? kNoTorque : to_string(fault.code));
    }
  }
  const bool begins = wanted_ && !blocked_ && robot_.states.is(GroupState::Standby) && group_.settled() &&
                      !group_.is_serving() && !robot_.axes.any_busy();
  weighing_ = begins ? weighing_ + robot_.period : 0;
  torques_.guide(begins ? TorqueWatch::Guided::Weighed : TorqueWatch::Guided::No);
  if (weighing_ < kWeighTime) {
    return;
  }
  weighing_ = 0;
  if (const Fault fault = weigh(); !fault.ok()) {
    refuse(fault, text_);
    return;
  }
  on_ = true;
  pace_ = 1;
  velocity_.setZero();
  watch_.begin();
  robot_.states.report(ErrorCode::Ok, 0);
  robot_.states.move();
}

Fault Guiding::may_begin(const ModeGuard& mode) const noexcept {
  if (!mode.permits_guiding()) {
    return {mode.permit() != ErrorCode::Ok ? mode.permit() : ErrorCode::Mode};
  }
  if (const int axis = torques_.first_unknown(); axis >= 0) {
    return {ErrorCode::NoTorque, axis + 1};
  }
  return {group_.may_move()};
}

// At rest nothing pushes, unless the hand does already or the arm holds something else than it knows.
Fault Guiding::weigh() noexcept {
  const Joints moving = moving_part(torques_.push());
  for (int i = 0; i < robot_.count(); ++i) {
    if (moving[i] != 0) {
      std::snprintf(text_, sizeof text_,
                    "axis %d is pushed with %.0f %s before guiding begins: release it first, or correct TOOL and LOAD",
                    i + 1, std::abs(torques_.push()[i]), robot_.parts.arm.axis(i).slides() ? "N" : "N m");
      return {ErrorCode::Contact, i + 1};
    }
  }
  return {};
}

void Guiding::refuse(const Fault& fault, const char* why) noexcept {
  blocked_ = true;
  robot_.states.report(fault.code, fault.axis);
  robot_.job.set_message(why);
}

// What is beyond the threshold and, of an axis at rest, its dry friction.
Joints Guiding::moving_part(const Joints& push) const noexcept {
  const Joints dry = robot_.tool.dynamics().friction().dry;
  Joints moving = Joints::Zero();
  for (int i = 0; i < robot_.count(); ++i) {
    const bool slow = std::abs(robot_.axes[i].commanded().velocity) < kDrySpeed;
    const double least = threshold_[i] + (slow ? dry[i] : 0);
    const bool moves = !robot_.parts.arm.moves_workpiece(i) && !(std::abs(push[i]) <= least);
    moving[i] = moves ? push[i] - std::copysign(least, push[i]) : 0;
  }
  return moving;
}

// The mass that the hand feels in this period.
void Guiding::feel() noexcept {
  const Settings& settings = robot_.parts.settings;
  GuideWatch::Seen seen;
  seen.push = torques_.push();
  seen.moving = moving_part(seen.push);
  seen.raw = torques_.raw();
  seen.end = robot_.tool.bare_arm().jacobian(robot_.commanded());
  if (const Fault fault = watch_.step(seen, robot_.count(), robot_.period); !fault.ok()) {
    group_.trip(fault.code, fault.axis, 1);
    robot_.job.set_message(watch_.text());
    return;
  }
  const Joints lever = hand_levers(seen.end, robot_.count());
  const double left = std::exp(-robot_.period * settings.guide_damping / settings.guide_mass);
  for (int i = 0; i < robot_.count(); ++i) {
    const double steady = seen.moving[i] / (settings.guide_damping * lever[i] * lever[i]);
    velocity_[i] = steady + left * (velocity_[i] - steady);
  }
}

void Guiding::brake_at_walls(Joints& velocity) const noexcept {
  for (int i = 0; i < robot_.count(); ++i) {
    const Axis& axis = robot_.parts.arm.axis(i);
    const double most = kGuidedPart * robot_.parts.joints.velocity[i];
    velocity[i] = std::clamp(velocity[i], -most, most);
    const double now = robot_.axes[i].commanded().position;
    velocity[i] = std::min(velocity[i], std::max(0.0, axis.highest() - kWallMargin - now) / kWallTime);
    velocity[i] = std::max(velocity[i], -std::max(0.0, now - axis.lowest() - kWallMargin) / kWallTime);
  }
}

// The mass is no faster than the arm: a hand that is taken away after a hard push stops it as soon as any other.
Joints Guiding::shaped() noexcept {
  brake_at_walls(velocity_);
  const Joints q = robot_.commanded();
  const auto farthest = [&](const Joints& velocity) {
    TipSpeed tip(robot_.tool.arm());
    tip.begin(q);
    tip.note(q + velocity * robot_.period);
    return tip.farthest() / robot_.period;
  };
  const double fast = farthest(velocity_);
  velocity_ *= fast > kGuidedSpeed ? kGuidedSpeed / fast : 1;
  const double most = kGuidedSpeed * pace_ * part_;
  return fast > most ? Joints(velocity_ * (most / std::min(fast, kGuidedSpeed))) : velocity_;
}

void Guiding::follow(int axis, double velocity) noexcept {
  AxisControl& a = robot_.axes[axis];
  const LineLimits limits = limits_of_axis(robot_.parts.joints, axis);
  a.follow(Profile::to_velocity(a.commanded(), velocity, limits).at(robot_.period));
}

void Guiding::move(LastGate& gate) noexcept {
  torques_.guide(TorqueWatch::Guided::Moved);
  if (wanted_) {
    feel();
  } else {
    velocity_.setZero();
  }
  if (!robot_.states.moving()) {
    return;
  }
  std::array<LineState, kAxes> before;
  for (int i = 0; i < robot_.count(); ++i) {
    before[at(i)] = robot_.axes[i].commanded();
  }
  const Joints wanted = wanted_ ? shaped() : Joints::Zero();
  for (int i = 0; i < robot_.count(); ++i) {
    follow(i, wanted[i]);
    if (!gate.passes(i)) {
      robot_.axes[i].put(before[at(i)]);
      follow(i, 0);
    }
  }
  pace_ = std::min(1.0, pace_ + robot_.period / kPaceTime);
  if (wanted_ && !gate.passes()) {
    pace_ = std::max(kLeastPace, kRefusedPace * pace_);
    velocity_ *= kRefusedPace;
    for (int i = 0; i < robot_.count(); ++i) {
      robot_.axes[i].put(before[at(i)]);
      follow(i, 0);
    }
  }
  robot_.follower.reset(robot_.commanded());
  if (!wanted_ && robot_.axes.at_rest()) {
    group_.come_to_standby();
  }
}

}  // namespace indurop::robot
