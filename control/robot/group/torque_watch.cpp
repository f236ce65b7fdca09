// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/torque_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "control/robot/kinematics/settings.h"

namespace indurop::robot {

namespace {

constexpr double kThousandth = 1000;

}  // namespace

TorqueWatch::TorqueWatch(Robot& robot, GroupPort& group) noexcept
    : robot_(robot),
      group_(group),
      rated_(of_axes(robot.parts.settings.rated_torque)),
      contact_(of_axes(robot.parts.settings.collision_limit)) {
  feed_.reweigh();
  for (int i = 0; i < robot_.count(); ++i) {
    robot_.axes[i].allow_torque(most_torque(i));
  }
}

// The maximum torque with which an axis may push; 0: unknown for its drive or for the arm.
double TorqueWatch::most_torque(int axis) const noexcept {
  const bool known = robot_.tool.dynamics().known() && rated_[axis] > 0;
  const double effort = robot_.tool.dynamics().effort()[axis];
  return !known ? 0 : effort > 0 ? effort : rated_[axis];
}

// A drive that is homing moves on its own. An axis that pushes is meant to do so, and the obstacle may remain.
void TorqueWatch::step(const Inputs& in) noexcept {
  const Joints measured = robot_.axes.measured();
  for (int i = 0; i < robot_.count(); ++i) {
    raw_[at(i)] = in.drives[at(i)].torque;
    torque_[i] = robot_.axes[i].drive_way() * in.drives[at(i)].torque * rated_[i] / kThousandth;
  }
  const bool watched = !robot_.parts.settings.collision_limit.empty() || guided_ != Guided::No;
  if (!watched || !robot_.axes.all_enabled() || robot_.states.is(GroupState::Homing)) {
    contact_.rest();
    return;
  }
  const int axis = contact_.step(robot_.tool.dynamics(), measured, torque_, robot_.period);
  if (robot_.axes.any_pushes() || guided_ == Guided::Moved) {
    contact_.release();
    return;
  }
  if (axis < 0 || !robot_.states.powered() || robot_.states.to_error()) {
    return;
  }
  std::snprintf(
      text_, sizeof text_,
      "something pushes against axis %d with at least %.0f %s, or the arm does not hold what TOOL and LOAD say",
      axis + 1, std::abs(contact_.residual()[axis]), robot_.parts.arm.axis(axis).slides() ? "N" : "N m");
  group_.trip(ErrorCode::Contact, axis + 1, robot_.parts.settings.emergency_factor, text_);
}

int TorqueWatch::first_unknown() const noexcept {
  const bool known = robot_.tool.dynamics().known();
  for (int i = 0; i < robot_.count(); ++i) {
    if (!robot_.parts.arm.moves_workpiece(i) && !(known && rated_[i] > 0)) {
      return i;
    }
  }
  return -1;
}

void TorqueWatch::weigh_pushing() noexcept {
  for (int i = 0; i < robot_.count(); ++i) {
    if (!robot_.axes[i].pushes()) {
      continue;
    }
    Joints one = Joints::Zero();
    one[i] = 1;
    TorqueControl::Load load;
    load.inertia = robot_.tool.dynamics().inertial(robot_.commanded(), one)[i];
    const double most = most_torque(i);
    const double held = needed()[i];
    load.lower = -most - held;
    load.upper = most - held;
    robot_.axes[i].carry(load);
  }
}

// Torques of the commanded motion. Friction is not included if the drive reports the speed of the axis: a value above
// the real friction would turn the axis.
Joints TorqueWatch::needed() const noexcept {
  Joints velocity = Joints::Zero();
  Joints acceleration = Joints::Zero();
  Joints own = Joints::Zero();
  for (int i = 0; i < robot_.count(); ++i) {
    velocity[i] = robot_.axes[i].commanded().velocity;
    acceleration[i] = robot_.axes[i].commanded().acceleration;
    own[i] = robot_.axes[i].pushes() ? 0 : velocity[i];
  }
  return robot_.tool.dynamics().torques(robot_.commanded(), velocity, acceleration) +
         robot_.tool.dynamics().friction(own);
}

void TorqueWatch::feed(Outputs& out) noexcept {
  if (!robot_.tool.dynamics().known() || !(rated_.array() > 0).any() || !robot_.axes.any_enabled()) {
    feed_.rest();
    return;
  }
  const auto share = [this](int axis, double torque) {
    constexpr double kLargest16 = 32767;
    const double thousandths = robot_.axes[axis].command_way() * kThousandth * torque / rated_[axis];
    return static_cast<std::int16_t>(std::clamp(std::round(thousandths), -kLargest16, kLargest16));
  };
  const Joints& torques = feed_.step(needed(), robot_.period);
  for (int i = 0; i < robot_.count(); ++i) {
    const double most = robot_.tool.dynamics().effort()[i] > 0 ? robot_.tool.dynamics().effort()[i] : HUGE_VAL;
    out.drives[at(i)].torque_offset = share(i, std::clamp(torques[i], -most, most));
    out.drives[at(i)].torque = share(i, robot_.axes[i].torque());
  }
}

void TorqueWatch::report(Outputs& out) const noexcept {
  for (int i = 0; i < kAxes; ++i) {
    out.axes[at(i)].torque = torque_[i];
    out.axes[at(i)].push = contact_.residual()[i];
  }
}

}  // namespace indurop::robot
