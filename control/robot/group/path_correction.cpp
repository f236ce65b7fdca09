// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/path_correction.h"

#include <algorithm>
#include <cmath>

#include "control/robot/group/torque_now.h"

namespace indurop::robot {

namespace {

constexpr double kShiftLook = 1e-4;  // m, to determine which joint motion a shift requires
// Part of the joints' limits for the shift along all directions together.
constexpr double kShare = PathCorrection::kReserve / 2;
constexpr double kShiftExact = 1e-6;  // m
constexpr double kInside = 0.99;      // part of the limit of a job that is used
// s and periods in which a missing force becomes 1/e of it: slow enough for sensors and drives that are some periods
// late. What the surface does is learned in a multiple of it.
constexpr double kPressTime = 0.06;
constexpr double kPressPeriods = 15;
constexpr double kLasting = 4;

}  // namespace

void PathCorrection::begin(const CorrectionWay& way) noexcept {
  end();
  way_ = way;
  on_ = shifts_ = true;
  // None depends on the others, so all of them together have to be within the limits of the whole shift.
  part_ = 1 / std::sqrt(std::max(1.0, static_cast<double>(way_.directions())));
  const Joints here = robot_.commanded();
  for (std::size_t k = 0; k < kDirections; ++k) {
    measure(k, here);
  }
}

void PathCorrection::end() noexcept {
  on_ = shifts_ = false;
  wanted_ = Vec3::Zero();
  needs_ = {};
  lasting_ = {};
  shift_ = {};
}

void PathCorrection::stand() noexcept {
  if (shifts_) {
    robot_.follower.reset(robot_.commanded());
  }
  shifts_ = false;
  for (LineState& each : shift_) {
    each = {each.position, 0, 0};
  }
}

bool PathCorrection::at_rest() const noexcept {
  return !shifts_ || std::all_of(shift_.begin(), shift_.end(),
                                 [](const LineState& each) { return each.velocity == 0 && each.acceleration == 0; });
}

bool PathCorrection::shifted() const noexcept {
  return std::any_of(shift_.begin(), shift_.end(), [](const LineState& each) { return each.position != 0; });
}

double PathCorrection::speed() const noexcept {
  return !shifts_ ? 0 : way_.rate * (presses() ? 1 : std::sqrt(static_cast<double>(kDirections)));
}

Mat3 PathCorrection::axes_at(const Pose& tip) const noexcept {
  return (way_.by_tool ? tip.orientation : way_.axes).toRotationMatrix();
}

// Determines how far the joints have to move for a shift in one direction. What cannot be determined stays as it is.
void PathCorrection::measure(std::size_t direction, const Joints& q) noexcept {
  Pose tip = robot_.tip(q);
  tip.position += kShiftLook * axes_at(tip).col(static_cast<Eigen::Index>(direction));
  const Inverse& inverse = robot_.tool.inverse();
  const Inverse::Result result = inverse.nearest(tip, inverse.held_as(q, q));
  if (result.reach == Reach::Ok) {
    rates_[direction] = (result.solution.q - q).cwiseAbs() / kShiftLook;
  }
}

LineLimits PathCorrection::limits_of(std::size_t direction) const noexcept {
  const JointLimits& joints = robot_.parts.joints;
  const ToolLimits& tool = robot_.parts.tool;
  const double share = kShare / (presses() ? way_.directions() : static_cast<int>(kDirections));
  LineLimits limits{part_ * way_.rate, tool.acceleration, tool.jerk};
  for (int i = 0; i < robot_.count(); ++i) {
    const double rate = rates_[direction][i];
    if (rate > 0) {
      limits.velocity = std::min(limits.velocity, share * joints.velocity[i] / rate);
      limits.acceleration = std::min(limits.acceleration, share * joints.acceleration[i] / rate);
      limits.jerk = std::min(limits.jerk, share * joints.jerk[i] / rate);
    }
  }
  return limits;
}

// The way of the shift in one direction to rest there, or where it can. Further along the path, the joints can brake
// less than they could when the shift began to move; it then brakes harder, with what is left of the reserve.
Profile PathCorrection::way_of(std::size_t direction, std::optional<double> to) const noexcept {
  const LineState& from = shift_[direction];
  const double limit = part_ * way_.limit;
  const double most = kInside * limit;
  const double place = std::clamp(to.value_or(0), -most, most);
  const LineLimits usual = limits_of(direction);
  Profile way;
  for (const double hardness : {1.0, 1.5, 2.5, 4.0}) {
    const LineLimits limits{usual.velocity, hardness * usual.acceleration, hardness * usual.jerk};
    way = to ? Profile::to_rest(from, place, limits) : Profile::to_velocity(from, 0, limits);
    const auto [low, high] = way.extent();
    if (low >= -limit && high <= limit) {
      break;
    }
  }
  return way;
}

// In one direction: as fast as the missing force demands, at most as fast as override and limits permit, and only as
// far as the limit of the job: where that would be passed, it comes to rest there.
Profile PathCorrection::way_of_press(std::size_t direction) noexcept {
  const LineState& from = shift_[direction];
  const LineLimits limits = limits_of(direction);
  const PressNeed& need = needs_[direction];
  double& lasting = lasting_[direction];
  const double time = std::max(kPressTime, kPressPeriods * robot_.period);
  // A speed that cannot be left within that time would make the force swing.
  const double agile = std::min(limits.jerk * time * time / 4, limits.acceleration * time / 2);
  const double most = pace_ * std::min(limits.velocity, agile);
  lasting += need.missing * robot_.period / (kLasting * time);
  lasting = need.touches ? std::clamp(lasting, -most * time, most * time) : 0;
  const double wanted = (need.missing + lasting) / time;
  const Profile way = Profile::to_velocity(from, std::clamp(wanted, -most, most), limits);
  const auto [low, high] = Profile::to_velocity(way.at(robot_.period), 0, limits).extent();
  const double limit = part_ * way_.limit;
  if (low >= -kInside * limit && high <= kInside * limit) {
    return way;
  }
  return way_of(direction, high > kInside * limit ? limit : -limit);
}

// Each direction on its own, so that none of them ever exceeds the limit of the job.
void PathCorrection::move() noexcept {
  const bool moving = !robot_.follower.at_rest();
  for (std::size_t k = 0; k < kDirections; ++k) {
    const auto to = moving ? std::optional(wanted_[static_cast<Eigen::Index>(k)]) : std::nullopt;
    const Profile way = way_.pressed[k] ? way_of_press(k) : way_of(k, to);
    LineState next = way.at(robot_.period);
    if (way.duration() <= robot_.period && way.end().velocity == 0) {
      next = {way.end().position, 0, 0};
    }
    next.position = std::clamp(next.position, -part_ * way_.limit, part_ * way_.limit);
    shift_[k] = next;
  }
  needs_ = {};
}

Fault PathCorrection::place(Joints& q) const noexcept {
  Pose tip = robot_.tip(q);
  const Vec3 by(shift_[0].position, shift_[1].position, shift_[2].position);
  tip.position += axes_at(tip) * by;
  const Inverse& inverse = robot_.tool.inverse();
  const Inverse::Result result = inverse.nearest(tip, inverse.held_as(q, robot_.commanded()));
  if (result.reach != Reach::Ok) {
    return {code_of(result.reach)};
  }
  q = result.solution.q;
  return (robot_.tip(q).position - tip.position).norm() > kShiftExact ? Fault{ErrorCode::Unreachable} : Fault{};
}

Fault PathCorrection::shift(Joints& q) noexcept {
  if (!shifts_) {
    return {};
  }
  measure(next_, q);
  next_ = (next_ + 1) % kDirections;
  move();
  if (!shifted()) {
    return {};
  }
  if (const Fault fault = place(q); !fault.ok()) {
    return fault;
  }
  return too_heavy(robot_, q);
}

bool PathCorrection::shift_kept(Joints& q) const noexcept {
  return !on_ || !shifted() || place(q).ok();
}

}  // namespace indurop::robot
