// SPDX-License-Identifier: Apache-2.0
// Torques of the group: what the arm holds, what the drives are told before they see it, and who pushes.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "robot/group.h"
#include "robot/settings.h"

namespace indurop::robot {

namespace {

constexpr double kThousandth = 1000;

constexpr std::size_t at(int axis) noexcept {
  return static_cast<std::size_t>(axis);
}

}  // namespace

// Nothing is planned.
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

// A drive that looks for its place moves by itself.
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
  if (axis < 0 || !powered() || to_error_) {
    return;
  }
  std::snprintf(
      contact_text_, sizeof contact_text_,
      "something pushes against axis %d with at least %.0f %s, or the arm does not hold what TOOL and LOAD say",
      axis + 1, std::abs(contact_.residual()[axis]), parts_.arm.axis(axis).slides() ? "N" : "N m");
  trip(ErrorCode::Contact, axis + 1, parts_.settings.emergency_factor);
}

// 1/1000 of the rated torque, as the drive takes it (60B2h).
void Group::feed_torques(Outputs& out) noexcept {
  if (!dynamics_.known() || !(rated_.array() > 0).any() || !all_enabled()) {
    feed_.rest();
    return;
  }
  Joints velocity = Joints::Zero();
  Joints acceleration = Joints::Zero();
  for (int i = 0; i < count(); ++i) {
    velocity[i] = axes_[at(i)].commanded().velocity;
    acceleration[i] = axes_[at(i)].commanded().acceleration;
  }
  const Joints needed = dynamics_.torques(commanded(), velocity, acceleration) + dynamics_.friction(velocity);
  const Joints& told = feed_.step(needed, period_);
  for (int i = 0; i < count(); ++i) {
    constexpr double kMost = 32767;
    const double share = std::round(axes_[at(i)].command_way() * kThousandth * told[i] / rated_[i]);
    out.drives[at(i)].torque_offset = static_cast<std::int16_t>(std::clamp(share, -kMost, kMost));
  }
}

}  // namespace indurop::robot
