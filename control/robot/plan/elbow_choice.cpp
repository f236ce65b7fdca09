// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/elbow_choice.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kGrid = radians(10);  // between angles, counted from 0: a cycle of motions returns to the same ones
constexpr double kBetter = 0.01;       // rad of room that are worth a movement
constexpr double kJump = 1;            // rad between two places: another posture

}  // namespace

ElbowChoice::ElbowChoice(const Places& places, Draft& draft) noexcept : places_(places), draft_(draft) {}

void ElbowChoice::begin() noexcept {
  const Segment& s = draft_.segment;
  reset();
  const Held held = places_.inverse().held();
  if (held == 0 || draft_.elbow_given || s.joint_path != nullptr) {
    return;
  }
  axis_ = -1;
  for (int i = 0; i < places_.arm().count(); ++i) {
    const bool turns = holds(held, i) && !places_.arm().axis(i).slides() && !places_.arm().moves_workpiece(i);
    axis_ = turns && axis_ < 0 ? i : axis_;
  }
  if (axis_ < 0) {
    return;
  }
  rooms_ = room_of(places_.arm(), s.from);
  farthest_ = draft_.joints.velocity[axis_] * s.length;  // whatever the speed and acceleration of the command are
  chosen_ = s.from[axis_];
  best_ = -HUGE_VAL;
  held_ = best_ = walk(chosen_);
  next_ = 0;
  searching_ = held_ < 0;
}

// The angles come in pairs, one below and one above the present one, from the nearest on.
void ElbowChoice::check(int& places) noexcept {
  const Axis& a = places_.arm().axis(axis_);
  const double from = draft_.segment.from[axis_];
  for (; places > 0 && searching_; places -= 2 * kPlaces, ++next_) {
    const double below = (std::ceil(from / kGrid) - 1 - next_) * kGrid;
    const double above = (std::floor(from / kGrid) + 1 + next_) * kGrid;
    double least = from - farthest_;
    double most = from + farthest_;
    if (!a.endless) {
      least = std::max(least, a.lower + kElbowRoom);
      most = std::min(most, a.upper - kElbowRoom);
    }
    if ((below < least && above > most) || next_ * kGrid > kPi) {
      finish();
      return;
    }
    const bool first_below = from - below < above - from;
    for (const double angle : {first_below ? below : above, first_below ? above : below}) {
      if (searching_ && angle >= least && angle <= most) {
        try_angle(angle);
      }
    }
  }
}

void ElbowChoice::try_angle(double angle) noexcept {
  const double found = walk(angle);
  if (found > best_ + (best_ == held_ ? kBetter : 0)) {
    best_ = found;
    chosen_ = angle;
  }
  if (found >= 0) {
    finish();
  }
}

// Returns by how much the room is more than wanted, where it is least: kElbowRoom, or where the path begins with less,
// uniformly more up to its end. It ends early where it is not better than the best. -infinity: the pose is not reached.
double ElbowChoice::walk(double angle) noexcept {
  Segment& s = draft_.segment;
  move_to(angle);
  Joints q = s.from;
  double least = HUGE_VAL;
  for (int i = 1; i <= kPlaces && least >= best_; ++i) {
    const double part = static_cast<double>(i) / kPlaces;
    const Joints before = q;
    draft_.work.add_on_path(1);
    if (places_.on(s, s.length * part, before, q) != Reach::Ok || (q - before).cwiseAbs().maxCoeff() > kJump) {
      least = -HUGE_VAL;
      break;
    }
    const double wanted = kElbowRoom + std::min(0.0, rooms_ - kElbowRoom) * (1 - part);
    least = std::min(least, room_of(places_.arm(), q) - wanted + 1e-9);
  }
  s.elbow_moves = false;
  return least;
}

void ElbowChoice::move_to(double angle) noexcept {
  Segment& s = draft_.segment;
  s.elbow = s.from;
  s.elbow[axis_] = angle;
  s.elbow_moves = angle != s.from[axis_];
}

void ElbowChoice::finish() noexcept {
  searching_ = false;
  moved_ = best_ > held_;
  if (moved_) {
    staying_ = draft_.segment;
    move_to(chosen_);
  }
}

bool ElbowChoice::give_up() noexcept {
  const bool may_stay = moved_ && std::isfinite(held_) && draft_.work.places() < PlanningWork::kMaxRefusalWork / 2;
  moved_ = false;
  if (may_stay) {
    draft_.segment = staying_;
  }
  return may_stay;
}

}  // namespace indurop::robot
