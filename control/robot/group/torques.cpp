// SPDX-License-Identifier: Apache-2.0
// Torques of the group: what the arm holds, the feed-forward of the drives, and contact detection.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "control/robot/group/group.h"
#include "control/robot/kinematics/settings.h"

namespace indurop::robot {

namespace {

constexpr double kThousandth = 1000;

}  // namespace

// Called only while nothing is planned.
void Group::weigh() noexcept {
  const JobBook& book = parts_.book;
  dynamics_.hold(joined(book.tools[static_cast<std::size_t>(tool_)].body, load_));
  feed_.reweigh();
}

bool Group::take_load(int load) noexcept {
  if (!settled() || desk_.holds_forgotten()) {
    return false;
  }
  load_ = parts_.book.loads[at(load)];
  weigh();
  return true;
}

void Group::set_up_torques() noexcept {
  weigh();
  places_.weigh(dynamics_.limited() ? &dynamics_ : nullptr);
  rated_ = of_axes(parts_.settings.rated_torque);
  contact_ = ContactWatch(of_axes(parts_.settings.collision_limit));
}

// The maximum torque with which an axis may push; 0: unknown for its drive or for the arm.
double Group::most_torque(int axis) const noexcept {
  const bool known = dynamics_.known() && rated_[axis] > 0;
  const double effort = dynamics_.effort()[axis];
  return !known ? 0 : effort > 0 ? effort : rated_[axis];
}

// A drive that is homing moves on its own. An axis that pushes is meant to do so, and the obstacle may remain.
void Group::watch_contact(const Inputs& in) noexcept {
  Joints measured = Joints::Zero();
  for (int i = 0; i < count(); ++i) {
    measured[i] = axes_[at(i)].measured();
    torque_[i] = axes_[at(i)].drive_way() * in.drives[at(i)].torque * rated_[i] / kThousandth;
  }
  if (parts_.settings.collision_limit.empty() || !all_enabled() || state_ == GroupState::Homing) {
    contact_.rest();
    return;
  }
  const int axis = contact_.step(dynamics_, measured, torque_, period_);
  if (std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.pushes(); })) {
    contact_.release();
    return;
  }
  if (axis < 0 || !powered() || to_error_) {
    return;
  }
  std::snprintf(
      contact_text_, sizeof contact_text_,
      "something pushes against axis %d with at least %.0f %s, or the arm does not hold what TOOL and LOAD say",
      axis + 1, std::abs(contact_.residual()[axis]), parts_.arm.axis(axis).slides() ? "N" : "N m");
  trip(ErrorCode::Contact, axis + 1, parts_.settings.emergency_factor);
}

// Sets the inertia that each pushing axis moves, and the part of its effort that is left.
void Group::weigh_pushing() noexcept {
  for (int i = 0; i < count(); ++i) {
    if (!axes_[at(i)].pushes()) {
      continue;
    }
    Joints one = Joints::Zero();
    one[i] = 1;
    TorqueControl::Load load;
    load.inertia = dynamics_.inertial(commanded(), one)[i];
    const double most = most_torque(i);
    const double needed = needed_torques()[i];
    load.lower = -most - needed;
    load.upper = most - needed;
    axes_[at(i)].carry(load);
  }
}

// Torques of the commanded motion. Friction is not included if the drive reports the speed of the axis: a value above
// the real friction would turn the axis.
Joints Group::needed_torques() const noexcept {
  Joints velocity = Joints::Zero();
  Joints acceleration = Joints::Zero();
  Joints own = Joints::Zero();
  for (int i = 0; i < count(); ++i) {
    velocity[i] = axes_[at(i)].commanded().velocity;
    acceleration[i] = axes_[at(i)].commanded().acceleration;
    own[i] = axes_[at(i)].pushes() ? 0 : velocity[i];
  }
  return dynamics_.torques(commanded(), velocity, acceleration) + dynamics_.friction(own);
}

// Feed-forward in 1/1000 of the rated torque, as the drive expects it (60B2h, 6071h).
void Group::feed_torques(Outputs& out) noexcept {
  const bool any = std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.drive().enabled(); });
  if (!dynamics_.known() || !(rated_.array() > 0).any() || !any) {
    feed_.rest();
    return;
  }
  const auto share = [this](int axis, double torque) {
    constexpr double kMost = 32767;
    const double thousandths = axes_[at(axis)].command_way() * kThousandth * torque / rated_[axis];
    return static_cast<std::int16_t>(std::clamp(std::round(thousandths), -kMost, kMost));
  };
  const Joints& told = feed_.step(needed_torques(), period_);
  for (int i = 0; i < count(); ++i) {
    const double most = dynamics_.effort()[i] > 0 ? dynamics_.effort()[i] : HUGE_VAL;
    out.drives[at(i)].torque_offset = share(i, std::clamp(told[i], -most, most));
    out.drives[at(i)].torque = share(i, axes_[at(i)].torque());
  }
}

}  // namespace indurop::robot
