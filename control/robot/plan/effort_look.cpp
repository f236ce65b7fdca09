// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/effort_look.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kOfEffort = 0.99;  // part of the limits; margin for values between samples
constexpr int kFewestSamples = 32;  // number of places
constexpr int kMostSamples = 1500;
constexpr int kMostInWaves = 50'000;
constexpr double kStep = 0.004;  // s between instants of a timing
// Part of the speed below which a motion is rejected after however long a planning: it would nearly stand still.
constexpr double kStandstill = 1e-4;

// The torque of an axis as a function of the part of the speed: gravity and dry friction, damping, and inertial
// torques, which grow with its square.
struct Share {
  double still, rubbing, moving;
  [[nodiscard]] double at(double part) const noexcept { return still + part * (rubbing + part * moving); }
  // Returns the maximum in either direction from rest up to that part.
  [[nodiscard]] double most(double part) const noexcept {
    double most = std::max(std::abs(still), std::abs(at(part)));
    const double top = moving != 0 ? -rubbing / (2 * moving) : -1;
    return top > 0 && top < part ? std::max(most, std::abs(at(top))) : most;
  }
};

double enough(const Share& share, double part, double effort) noexcept {
  constexpr int kHalvings = 40;
  double low = 0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + part) / 2;
    double& bound = share.most(middle) <= effort ? low : part;
    bound = middle;
  }
  return low;
}

LineLimits slower_by(double factor, const LineLimits& limits) noexcept {
  return {limits.velocity / factor, limits.acceleration / (factor * factor), limits.jerk / (factor * factor * factor)};
}

}  // namespace

void EffortBound::look(const Dynamics& dynamics, const Joints& q, const Joints& first, const Joints& second,
                       std::span<const Pace> paces, double slowest) noexcept {
  const Joints rest = Joints::Zero();
  const Joints still = dynamics.torques(q, rest, rest);
  const Joints bent = dynamics.torques(q, first, second) - still;
  const Joints pushed = dynamics.inertial(q, first);
  for (const Pace& pace : paces) {
    const Joints speed = std::sqrt(pace.square) * first;
    const Joints damping = dynamics.friction().damping.cwiseProduct(speed);
    const Joints moving = pace.square * bent + pace.acceleration * pushed;
    for (int i = 0; i < kAxes; ++i) {
      const double effort = kOfEffort * dynamics.effort()[i];
      const double dry = speed[i] == 0 ? 0 : std::copysign(dynamics.friction().dry[i], speed[i]);
      const Share share{still[i] + dry, damping[i], moving[i]};
      if (!(effort > 0) || share.most(part_) <= effort) {
        continue;
      }
      part_ = enough(share, part_, effort);
      if (part_ < slowest) {
        part_ = slowest;
        fault_ = {ErrorCode::Torque, i + 1};
      }
    }
  }
}

// Paces at and below the planned pace, with the greatest change that is allowed there.
EffortLook::Paces EffortLook::changing(const PaceLimits& limits, double most) noexcept {
  Paces paces;
  for (std::size_t i = 0; i < kPaces; i += 2) {
    const double pace = most * (1 - static_cast<double>(i) / (kPaces - 2));
    const double change = std::max(0.0, limits.at(pace).acceleration);
    paces[i] = {pace * pace, change};
    paces[i + 1] = {pace * pace, -change};
  }
  return paces;
}

EffortLook::Paces EffortLook::at_one_speed(const LineLimits& limits) noexcept {
  const double square = limits.velocity * limits.velocity;
  const double change = limits.acceleration;
  return {{{square, change}, {square, -change}, {0, change}, {0, -change}, {square, 0}, {square, 0}}};
}

void EffortLook::begin(const Segment& segment) noexcept {
  way_ = Way::None;
  if (places_.dynamics() == nullptr || !(segment.length > 0)) {
    return;
  }
  // Even a segment with a timing is followed at one speed if the previous motion blends into it; a chain never is,
  // nor a wave, nor a free motion.
  const bool at_rest = segment.chain != nullptr || segment.wave.on() || segment.joint_path != nullptr;
  begin_way(segment, segment.move == Move::Joint         ? Way::JointsStraight
                     : at_rest && segment.timing.known() ? Way::Timing
                                                         : Way::Speed);
}

void EffortLook::begin_way(const Segment& segment, Way way) noexcept {
  way_ = way;
  bound_ = {};
  next_ = 0;
  seen_.fill(segment.from);
  constexpr double kNearlyFull = 1 - 1e-9;
  const int most = segment.wave.on() ? kMostInWaves : kMostSamples;
  const auto instants = [most](double duration) {
    return std::clamp(static_cast<int>(std::min(duration / kStep, 1e6)), kFewestSamples, most);
  };
  switch (way) {
    case Way::None:
      break;
    case Way::JointsAtOnce:
    case Way::JointsLeaving: {
      Segment trial = segment;
      trial.take_joint_timing({segment.from, Joints::Zero(), Joints::Zero()}, joints_,
                              way == Way::JointsAtOnce ? 1 : kNearlyFull);
      joint_timing_ = trial.joint_timing;
      paces_ = way == Way::JointsAtOnce ? Paces{} : changing(trial.pace_limits, trial.fastest);
      count_ = instants(joint_timing_.duration());
      break;
    }
    case Way::JointsStraight:
    case Way::Speed:
      paces_ = at_one_speed(segment.limits);
      count_ = way == Way::Speed ? most / 8 : kFewestSamples;
      break;
    case Way::Timing:
      paces_ = changing(segment.pace_limits, 1);
      count_ = instants(segment.timing.duration());
      break;
  }
}

// Each way of following it is slowed down separately; for joints that arrive together one factor applies to all.
void EffortLook::next_way(Segment& segment) noexcept {
  const double slower = bound_.slower();
  switch (way_) {
    case Way::None:
      break;
    case Way::JointsAtOnce:
      segment.slowness *= slower;
      begin_way(segment, Way::JointsLeaving);
      return;
    case Way::JointsLeaving:
      segment.slowness *= slower;
      break;
    case Way::JointsStraight:
    case Way::Speed:
      segment.limits = slower_by(slower, segment.limits);
      if (segment.together || segment.timing.known()) {
        begin_way(segment, segment.together ? Way::JointsAtOnce : Way::Timing);
        return;
      }
      break;
    case Way::Timing:
      segment.timing.slow_down(slower);
      segment.timing_tip_speed /= slower;
      segment.pace_limits.acceleration /= slower;
      segment.pace_limits.mixed /= slower;
      segment.pace_limits.jerk /= slower * slower;
      break;
  }
  way_ = Way::None;
}

void EffortLook::check_joints(const Segment& segment, double part) noexcept {
  if (way_ == Way::JointsStraight) {
    const Joints way = segment.to - segment.from;
    bound_.look(*places_.dynamics(), segment.from + part * way, way / segment.length, Joints::Zero(), paces_, slowest_);
    return;
  }
  const JointState state = joint_timing_.at(part * joint_timing_.duration());
  bound_.look(*places_.dynamics(), state.position, state.velocity, state.acceleration, paces_, slowest_);
}

// Checks the previous place, by differences.
void EffortLook::check_tool(const Segment& segment, double part) noexcept {
  const double whole = way_ == Way::Timing ? segment.timing.duration() : segment.length;
  const double along = way_ == Way::Timing ? segment.timing.at(part * whole).place : part * whole;
  seen_ = {seen_[1], seen_[2], seen_[2]};
  static_cast<void>(places_.on(segment, along, seen_[1], seen_[2]));  // known to be reachable
  if (next_ >= 2) {
    const double step = whole / count_;
    bound_.look(*places_.dynamics(), seen_[1], (seen_[2] - seen_[0]) / (2 * step),
                (seen_[2] - 2 * seen_[1] + seen_[0]) / (step * step), paces_, slowest_);
  }
}

Fault EffortLook::look(Segment& segment, bool may_refuse) noexcept {
  slowest_ = may_refuse ? EffortBound::kSlowest : kStandstill;
  const double part = static_cast<double>(next_) / count_;
  if (segment.move == Move::Joint) {
    check_joints(segment, part);
  } else {
    check_tool(segment, part);
  }
  if (!bound_.fault().ok()) {
    way_ = Way::None;
    return bound_.fault();
  }
  if (++next_ > count_) {
    next_way(segment);
  }
  return {};
}

Fault check_holding(const Dynamics& dynamics, const Joints* places, int count, int& place) noexcept {
  const auto still = [&](int i) { return dynamics.torques(places[i], Joints::Zero(), Joints::Zero()); };
  std::array<Joints, 3> near{Joints::Zero(), still(0), still(1)};
  for (place = 1; place < count; ++place) {
    near = {near[1], near[2], still(place + 1)};
    for (int i = 0; i < kAxes; ++i) {
      const double effort = kOfEffort * dynamics.effort()[i];
      const double moved = places[place + 1][i] - places[place - 1][i];
      const double dry = moved == 0 ? 0 : std::copysign(dynamics.friction().dry[i], moved);
      // The greatest torque may lie between two places.
      const double slope = (near[2][i] - near[0][i]) / 2;
      const double bend = near[2][i] - 2 * near[1][i] + near[0][i];
      const double peak =
          2 * std::abs(slope) <= std::abs(bend) && bend != 0 ? near[1][i] - slope * slope / (2 * bend) : near[1][i];
      if (effort > 0 && std::max(std::abs(near[1][i] + dry), std::abs(peak + dry)) > effort) {
        return {ErrorCode::Torque, i + 1};
      }
    }
  }
  return {};
}

bool slow_down(const Dynamics& dynamics, const Joints* places, int count, double spacing, LineLimits& limits) noexcept {
  const double square = limits.velocity * limits.velocity;
  const double change = limits.acceleration;
  const EffortBound::Pace paces[] = {{square, change}, {square, -change}, {0, change}, {0, -change}};
  EffortBound bound;
  for (int i = 1; i < count; ++i) {
    bound.look(dynamics, places[i], (places[i + 1] - places[i - 1]) / (2 * spacing),
               (places[i + 1] - 2 * places[i] + places[i - 1]) / (spacing * spacing), paces);
  }
  limits = slower_by(bound.slower(), limits);
  return bound.fault().ok();
}

}  // namespace indurop::robot
