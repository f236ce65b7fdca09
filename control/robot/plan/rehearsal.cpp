// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/rehearsal.h"

#include <algorithm>
#include <cmath>

#include "control/robot/path/rates.h"
#include "control/robot/plan/resting.h"

namespace indurop::robot {

namespace {

constexpr double kSure = 0.99;        // of the limits, margin for the motion between two instants
constexpr int kFewestInstants = 300;  // instants: jerk of short motions peaks between the knots of their timing
constexpr int kMaxInstants = 1 << 26;
constexpr int kLong = 20000;            // instants; longer motions have calm stretches
constexpr int kVeryLong = 1 << 20;      // instants
constexpr int kFewSkipped = 16;         // instants
constexpr int kMoreSkipped = 64;        // instants of long motions
constexpr int kManySkipped = 1024;      // instants of very long ones
constexpr double kQuiet = 0.5;          // factor of the last instant below which some may be skipped
constexpr double kSuspicious = 1.1;     // factor of jerk above which a joint may step
constexpr double kRoomForRest = 0.9;    // part of the room before the end of a range that a stop may use
constexpr double kRounding = 5e-10;     // rad or m, half of what the last gate lets pass beyond that end
constexpr double kSlowestForRest = 50;  // factor of slowness above which an axis is too near the end of its range

}  // namespace

void Rehearsal::begin(const Joints& from, double duration, double step, bool timed) noexcept {
  count_ = static_cast<int>(std::clamp(std::ceil(duration / step), double{kFewestInstants}, double{kMaxInstants}));
  step_ = duration / count_;
  next_ = 1;
  end_ = count_ + 3;
  worst_ = last_jerk_ = suspected_ = 0;
  restless_ = -1;
  acceleration_share_ = timed ? TimingShares::kAcceleration : Shares::kBending;
  jerk_share_ = timed ? TimingShares::kJerk : Shares::kBendingJerk;
  pace_ = {};
  seen_.fill(from);
  at_.fill(0);
  skip_ = wait_ = kFewSkipped;
  unknown_ = 0;
  tip_far_ = 0;
  tip_ = TipSpeed(places_.arm());
  tip_.begin(from);
}

void Rehearsal::begin_stretch(const Joints& from, double place, int first, int instants) noexcept {
  next_ = first + 1;
  end_ = first + instants;
  seen_.fill(from);
  at_.fill(place);
  unknown_ = 2;
}

double Rehearsal::time() const noexcept {
  return step_ * std::min(next_, count_);  // a few instants after the end, where it rests
}

bool Rehearsal::look(const Segment& segment, double place) noexcept {
  Joints here = seen_[0];
  if (places_.on(segment, place, seen_[0], here) != Reach::Ok) {
    return false;
  }
  seen_ = {here, seen_[0], seen_[1], seen_[2]};
  at_ = {place, at_[0], at_[1], at_[2]};
  tip_.note(here);
  ++next_;
  wait_ = std::max(0, wait_ - 1);
  if (unknown_ > 0) {
    --unknown_;
    last_jerk_ = 0;
    return true;
  }
  const auto& q = seen_;
  const Joints velocity = (q[0] - q[1]) / step_;
  const Joints acceleration = (q[0] - 2 * q[1] + q[2]) / (step_ * step_);
  const Joints first = velocity.cwiseAbs();
  const Joints second = acceleration.cwiseAbs();
  const Joints third = ((q[0] - 3 * q[1] + 3 * q[2] - q[3]) / (step_ * step_ * step_)).cwiseAbs();
  last_jerk_ = std::cbrt(third.cwiseQuotient(jerk_share_ * joints_.jerk).maxCoeff());
  last_ =
      std::max({first.cwiseQuotient(joints_.velocity).maxCoeff(),
                std::sqrt(second.cwiseQuotient(acceleration_share_ * joints_.acceleration).maxCoeff()), last_jerk_});
  if (last_ > worst_) {
    worst_ = last_;
    restless_ = -1;
  }
  check_rest(velocity + step_ / 2 * acceleration, acceleration);
  note(first, second);
  return true;
}

// An axis that is beyond the end of its range may return.
void Rehearsal::check_rest(const Joints& velocity, const Joints& acceleration) noexcept {
  for (int i = 0; i < places_.arm().count(); ++i) {
    const Axis& axis = places_.arm().axis(i);
    if (axis.endless) {
      continue;
    }
    const LineLimits limits = limits_of_axis(joints_, i);
    const double above = kRoomForRest * std::max(0.0, axis.upper - seen_[0][i]) + kRounding;
    const double below = kRoomForRest * std::max(0.0, seen_[0][i] - axis.lower) + kRounding;
    const double slower = std::max(slower_for_rest(above, velocity[i], acceleration[i], limits, kSlowestForRest),
                                   slower_for_rest(below, -velocity[i], -acceleration[i], limits, kSlowestForRest));
    if (slower <= 1) {
      continue;
    }
    last_ = std::max(last_, kSure * slower);
    if (last_ > worst_) {
      worst_ = last_;
      restless_ = i;
    }
  }
}

void Rehearsal::note(const Joints& first, const Joints& second) noexcept {
  for (int i = 0; i < kAxes; ++i) {
    pace_.acceleration = std::min(pace_.acceleration, shared(joints_.acceleration[i], first[i]));
    pace_.mixed = std::min(pace_.mixed, shared(joints_.jerk[i], second[i]));
    pace_.jerk = std::min(pace_.jerk, shared(joints_.jerk[i], first[i]));
  }
}

double Rehearsal::far_time() const noexcept {
  const bool may =
      count_ >= kLong && end_ > count_ && wait_ == 0 && unknown_ == 0 && last_ < kQuiet && next_ + skip_ < count_;
  return may ? step_ * (next_ - 1 + skip_) : -1;
}

void Rehearsal::skip(const Segment& segment, double far_place) noexcept {
  Joints far = seen_[0];
  if (places_.on(segment, far_place, seen_[0], far) != Reach::Ok || !calm(far)) {
    skip_ = std::max(skip_ / 2, kFewSkipped);
    wait_ = kFewSkipped;
    return;
  }
  constexpr double kFaster = 1.5;  // in between, at most
  const double span = skip_ * step_;
  const Joints speed = (far - seen_[0]) / span;
  const Joints before = (seen_[0] - seen_[1]) / step_;
  note(kFaster * speed.cwiseAbs(), 2 * kFaster * (speed - before).cwiseAbs() / span);
  TipSpeed tip(places_.arm());
  tip.begin(seen_[0]);
  tip.note(far);
  tip_far_ = std::max(tip_far_, kFaster * tip.farthest() / skip_);
  tip_.go_on_from(far);
  seen_.fill(far);
  at_.fill(far_place);
  unknown_ = 2;
  next_ += skip_;
  skip_ = std::min(2 * skip_, count_ < kVeryLong ? kMoreSkipped : kManySkipped);
  wait_ = unknown_ + 1;  // the next instant whose differences are known has to be quiet too
}

// Speeds that are so small that they may change at once are ignored. A joint that reverses in between has a different
// mean speed; near its limit it could leave its range and come back, which would be another posture.
bool Rehearsal::calm(const Joints& far) const noexcept {
  constexpr double kMoved = 0.05;  // rad or m
  constexpr double kFast = 0.3;
  constexpr double kSudden = 0.25;
  constexpr double kChange = 0.25;
  const double span = skip_ * step_;
  const Joints speed = (far - seen_[0]) / span;
  const Joints before = (seen_[0] - seen_[1]) / step_;
  Joints beyond = far - seen_[0];
  for (int i = 0; i < kAxes; ++i) {
    const double change = std::abs(speed[i] - before[i]);
    const double most = std::max(std::abs(speed[i]), std::abs(before[i]));
    const double sudden = kSudden * jerk_share_ * joints_.jerk[i] * step_ * step_;
    if (std::abs(far[i] - seen_[0][i]) > kMoved || most > kFast * joints_.velocity[i] ||
        change > std::max(kChange * most, sudden) ||
        change > kChange * acceleration_share_ * joints_.acceleration[i] * span ||
        change > kChange * jerk_share_ * joints_.jerk[i] * span * span) {
      return false;
    }
    beyond[i] += std::copysign(sudden * span, beyond[i]);
  }
  if (places_.arm().beyond_limits(far + beyond) >= 0 || places_.arm().beyond_limits(seen_[0] - beyond) >= 0) {
    return false;
  }
  const double here = places_.arm().volume(seen_[0]);
  const double there = places_.arm().volume(far);
  return std::min(std::abs(here), std::abs(there)) > 3 * std::abs(there - here);
}

bool Rehearsal::jumped() const noexcept {
  constexpr double kJump = radians(30);
  return (seen_[0] - seen_[1]).cwiseAbs().maxCoeff() > kJump;
}

bool Rehearsal::steps(const Segment& segment, int& places) noexcept {
  constexpr double kWorse = 1.5;
  if (last_jerk_ < std::max(kSuspicious, kWorse * suspected_)) {
    return false;
  }
  suspected_ = last_jerk_;
  return steps_before(0, segment, places) || steps_before(1, segment, places) || steps_before(2, segment, places);
}

// Halves the way from the instant before, and goes on where joints move more, until they move too little for a step.
bool Rehearsal::steps_before(std::size_t instant, const Segment& segment, int& places) const noexcept {
  constexpr int kHalves = 40;
  const Joints least = jerk_share_ * std::pow(step_, 3) / 2 * joints_.jerk;
  const auto moved = [&](const Joints& from, const Joints& to) {
    return (to - from).cwiseAbs().cwiseQuotient(least).maxCoeff();
  };
  Joints before = seen_[instant + 1];
  Joints behind = seen_[instant];
  double from = at_[instant + 1];
  double to = at_[instant];
  for (int half = 0; moved(before, behind) > 1; ++half) {
    const double place = (from + to) / 2;
    Joints here = before;
    ++places;
    if (half == kHalves || places_.on(segment, place, before, here) != Reach::Ok) {
      return true;
    }
    if (moved(before, here) > moved(here, behind)) {
      to = place;
      behind = here;
    } else {
      from = place;
      before = here;
    }
  }
  return false;
}

double Rehearsal::last_factor() const noexcept {
  return std::max(1.0, last_ / kSure);
}

double Rehearsal::factor() const noexcept {
  return std::max(1.0, worst_ / kSure);
}

}  // namespace indurop::robot
