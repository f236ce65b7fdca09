// SPDX-License-Identifier: Apache-2.0
#include "robot/spline.h"

#include <algorithm>
#include <cmath>

#include "robot/path_rates.h"

namespace indurop::robot {

namespace {

constexpr std::size_t at(int i) noexcept {
  return static_cast<std::size_t>(i);
}

}  // namespace

void Spline::begin(const Pose& start, const ToolLimits& tool) noexcept {
  tool_ = tool;
  count_ = 0;
  way_ = at_speed_ = at_[0] = 0;
  knots_[0].pose = start;
  values_[0] << start.position, start.orientation.coeffs();
}

bool Spline::add(const Knot& knot) noexcept {
  const Pose& from = knots_[at(count_)].pose;
  const double way = (knot.pose.position - from.position).norm();
  const double turn = rotation_between(from.orientation, knot.pose.orientation).norm();
  const double length = std::max(way / tool_.velocity, turn / tool_.turn_velocity);
  if (!(length > 1e-9)) {
    return false;
  }
  // Of the two ways to write an orientation the one that is nearer to the one before.
  const Eigen::Vector4d before = values_[at(count_)].tail<4>();
  const Eigen::Vector4d turned = knot.pose.orientation.coeffs();
  ++count_;
  knots_[at(count_)] = knot;
  values_[at(count_)] << knot.pose.position, before.dot(turned) < 0 ? -turned : turned;
  at_[at(count_)] = at_[at(count_) - 1] + length;
  way_ += way;
  at_speed_ += knot.tool_speed > 0 ? std::max(length, way / knot.tool_speed) : length / knot.speed;
  return true;
}

// Continuous slopes make a system with three diagonals for the second derivatives, which are 0 at the ends.
void Spline::finish() noexcept {
  std::array<double, kMost + 1> above{};
  bends_[0].setZero();
  bends_[at(count_)].setZero();
  for (int i = 1; i < count_; ++i) {
    const std::size_t k = at(i);
    const double before = at_[k] - at_[k - 1];
    const double behind = at_[k + 1] - at_[k];
    const Values change = (values_[k + 1] - values_[k]) / behind - (values_[k] - values_[k - 1]) / before;
    const double middle = 2 * (before + behind) - before * above[k - 1];
    above[k] = behind / middle;
    bends_[k] = (6 * change - before * bends_[k - 1]) / middle;
  }
  for (int i = count_ - 1; i > 0; --i) {
    bends_[at(i)] -= above[at(i)] * bends_[at(i) + 1];
  }
}

std::size_t Spline::piece_at(double place) const noexcept {
  const double* begin = at_.data();
  const auto next = static_cast<int>(std::upper_bound(begin, begin + count_, place) - begin);
  return at(std::clamp(next - 1, 0, count_ - 1));
}

Spline::Place Spline::look(double place) const noexcept {
  place = std::clamp(place, 0.0, length());
  const std::size_t k = piece_at(place);
  const double h = at_[k + 1] - at_[k];
  const double t = place - at_[k];
  const double rest = h - t;
  const Values& a = bends_[k];
  const Values& b = bends_[k + 1];
  const Values low = values_[k] / h - a * (h / 6);
  const Values high = values_[k + 1] / h - b * (h / 6);
  return {a * (rest * rest * rest / (6 * h)) + b * (t * t * t / (6 * h)) + low * rest + high * t,
          b * (t * t / (2 * h)) - a * (rest * rest / (2 * h)) + high - low, (a * rest + b * t) / h, (b - a) / h};
}

Pose Spline::pose_at(double place) const noexcept {
  const Values value = look(place).value;
  return {value.head<3>(), Quat(Eigen::Vector4d(value.tail<4>())).normalized()};
}

// In the tool's frame; only how long it is counts.
Vec3 Spline::turning_at(double place) const noexcept {
  const Place here = look(place);
  const double size = here.value.tail<4>().norm();
  const Eigen::Vector4d unit = here.value.tail<4>() / size;
  const Eigen::Vector4d slope = here.first.tail<4>();
  const Eigen::Vector4d change = (slope - unit * unit.dot(slope)) / size;
  return 2 * (Quat(unit).conjugate() * Quat(change)).vec();
}

LineLimits Spline::limits_at(double place) const noexcept {
  place = std::clamp(place, 0.0, length());
  const Place here = look(place);
  Shape shape;
  shape.moving = here.first.head<3>();
  shape.bend = here.second.head<3>();
  shape.twist = here.third.head<3>();
  // By differences within the piece.
  const std::size_t k = piece_at(place);
  const double step = (at_[k + 1] - at_[k]) / 64;
  const double middle = std::clamp(place, at_[k] + step, at_[k + 1] - step);
  const Vec3 before = turning_at(middle - step);
  const Vec3 behind = turning_at(middle + step);
  shape.turning = turning_at(place);
  shape.turn_bend = (behind - before) / (2 * step);
  shape.turn_twist = (behind - 2 * turning_at(middle) + before) / (step * step);
  const Knot& to = knots_[k + 1];
  const double part = to.tool_speed > 0 ? 1 : to.speed;
  const double speed = std::min({part, shared(part * tool_.velocity, shape.moving.norm()),
                                 shared(part * tool_.turn_velocity, shape.turning.norm()),
                                 to.tool_speed > 0 ? shared(to.tool_speed, shape.moving.norm()) : HUGE_VAL});
  return limits_for(shape, speed, tool_);
}

}  // namespace indurop::robot
