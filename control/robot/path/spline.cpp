// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/spline.h"

#include <algorithm>
#include <cmath>

#include "control/robot/path/rates.h"

namespace indurop::robot {

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
  // Of the two representations of an orientation the one closer to the previous one.
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

// Pieces of the fifth degree have the same third and fourth derivatives at each point, which yields a block system for
// the first and second ones. At the ends the second and fourth are 0.
void Spline::finish() noexcept {
  using Block = Eigen::Matrix2d;
  using Right = Eigen::Matrix<double, 2, 7>;
  std::array<Block, kMaxPoints + 1> above{};
  std::array<Right, kMaxPoints + 1> known{};
  for (int i = 0; i <= count_; ++i) {
    Block before = Block::Zero();
    Block here = Block::Zero();
    Block behind = Block::Zero();
    Right right = Right::Zero();
    if (i > 0) {
      const double h = at_[at(i)] - at_[at(i) - 1];
      const Values change = (values_[at(i)] - values_[at(i) - 1]) / h;
      before << -24, -3 * h, -168, -24 * h;
      here << -36, 9 * h, -192, 36 * h;
      before.row(0) /= h * h;
      here.row(0) /= h * h;
      before.row(1) /= h * h * h;
      here.row(1) /= h * h * h;
      right.row(0) = -60 / (h * h) * change.transpose();
      right.row(1) = -360 / (h * h * h) * change.transpose();
    }
    if (i < count_) {
      const double h = at_[at(i) + 1] - at_[at(i)];
      const Values change = (values_[at(i) + 1] - values_[at(i)]) / h;
      Block first;
      first << 36, 9 * h, -192, -36 * h;
      behind << 24, -3 * h, -168, 24 * h;
      here.row(0) += first.row(0) / (h * h);
      here.row(1) += first.row(1) / (h * h * h);
      behind.row(0) /= h * h;
      behind.row(1) /= h * h * h;
      right.row(0) += 60 / (h * h) * change.transpose();
      right.row(1) -= 360 / (h * h * h) * change.transpose();
    }
    if (i == 0 || i == count_) {
      before.row(0).setZero();
      behind.row(0).setZero();
      here.row(0) << 0, 1;
      right.row(0).setZero();
    }
    if (i > 0) {
      here -= before * above[at(i) - 1];
      right -= before * known[at(i) - 1];
    }
    const Block inverse = here.inverse();
    above[at(i)] = inverse * behind;
    known[at(i)] = inverse * right;
  }
  for (int i = count_; i >= 0; --i) {
    if (i < count_) {
      known[at(i)] -= above[at(i)] * known[at(i) + 1];
    }
    slopes_[at(i)] = known[at(i)].row(0);
    bends_[at(i)] = known[at(i)].row(1);
  }
  measure();
}

void Spline::measure() noexcept {
  gone_[0] = 0;
  for (int i = 0; i < count_; ++i) {
    gone_[at(i) + 1] = gone_[at(i)] + distance(at(i), at_[at(i) + 1]);
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
  const Values& slope = slopes_[k];
  const Values& bend = bends_[k];
  // The difference between the end of the piece and its start continued.
  const Values way = (values_[k + 1] - values_[k]) / (h * h) - slope / h - bend / 2;
  const Values turn = (slopes_[k + 1] - slope) / h - bend;
  const Values more = bends_[k + 1] - bend;
  const Values c3 = (10 * way - 4 * turn + more / 2) / h;
  const Values c4 = (-15 * way + 7 * turn - more) / (h * h);
  const Values c5 = (6 * way - 3 * turn + more / 2) / (h * h * h);
  return {values_[k] + t * (slope + t * (bend / 2 + t * (c3 + t * (c4 + t * c5)))),
          slope + t * (bend + t * (3 * c3 + t * (4 * c4 + t * 5 * c5))),
          bend + t * (6 * c3 + t * (12 * c4 + t * 20 * c5)), 6 * c3 + t * (24 * c4 + t * 60 * c5)};
}

// m on the curve from the beginning of a piece to a place of it, by Gaussian quadrature.
double Spline::distance(std::size_t piece, double place) const noexcept {
  constexpr std::array kAt{0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155, 0.95308992296933200};
  constexpr std::array kWeight{0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                               0.11846344252809454};
  const double way = place - at_[piece];
  double sum = 0;
  for (std::size_t i = 0; i < kAt.size(); ++i) {
    sum += kWeight[i] * look(at_[piece] + kAt[i] * way).first.head<3>().norm();
  }
  return way * sum;
}

PathWay Spline::way_at(double place) const noexcept {
  place = std::clamp(place, 0.0, length());
  const std::size_t piece = piece_at(place);
  return {gone_[piece] + distance(piece, place), gone_[at(count_)], look(place).first.head<3>()};
}

Pose Spline::pose_at(double place) const noexcept {
  const Values value = look(place).value;
  return {value.head<3>(), Quat(Eigen::Vector4d(value.tail<4>())).normalized()};
}

// In the tool's frame; only its length is used.
Vec3 Spline::turning_at(double place) const noexcept {
  const Place here = look(place);
  const double size = here.value.tail<4>().norm();
  const Eigen::Vector4d unit = here.value.tail<4>() / size;
  const Eigen::Vector4d slope = here.first.tail<4>();
  const Eigen::Vector4d change = (slope - unit * unit.dot(slope)) / size;
  return 2 * (Quat(unit).conjugate() * Quat(change)).vec();
}

Spline::Shape Spline::shape_at(double place) const noexcept {
  place = std::clamp(place, 0.0, length());
  const Place here = look(place);
  Shape shape;
  shape.moving = here.first.head<3>();
  shape.bend = here.second.head<3>();
  shape.twist = here.third.head<3>();
  // Computed by differences within the piece.
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
  shape.speed = std::min({part, shared(part * tool_.velocity, shape.moving.norm()),
                          shared(part * tool_.turn_velocity, shape.turning.norm()),
                          to.tool_speed > 0 ? shared(to.tool_speed, shape.moving.norm()) : HUGE_VAL});
  return shape;
}

}  // namespace indurop::robot
