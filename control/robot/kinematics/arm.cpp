// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/arm.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "control/robot/kinematics/held_axes.h"

namespace indurop::robot {

Mat3 turned(const Vec3& axis, double angle) noexcept {
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  const Vec3 t = (1 - c) * axis;
  Mat3 r;
  r << t.x() * axis.x() + c, t.x() * axis.y() - s * axis.z(), t.x() * axis.z() + s * axis.y(),
      t.x() * axis.y() + s * axis.z(), t.y() * axis.y() + c, t.y() * axis.z() - s * axis.x(),
      t.x() * axis.z() - s * axis.y(), t.y() * axis.z() + s * axis.x(), t.z() * axis.z() + c;
  return r;
}

Arm::Arm(Axes axes, const Pose& home, int count) noexcept : axes_(std::move(axes)), home_(home), count_(count) {
  for (; link_count_ < static_cast<std::size_t>(count); ++link_count_) {
    const Axis& a = axes_[link_count_];
    links_[link_count_] = {a.direction, a.point, a.kind, static_cast<int>(link_count_), 1};
  }
}

Arm::Arm(Axes axes, const Pose& home, int count, const Link* links, std::size_t link_count, int world_joint) noexcept
    : axes_(std::move(axes)),
      home_(home),
      count_(count),
      link_count_(std::min(link_count, kMostLinks)),
      world_joint_(world_joint) {
  std::copy_n(links, link_count_, links_.begin());
}

// The tool points down.
Arm::Arm(Axes axes, const Delta& delta, int count) noexcept
    : axes_(std::move(axes)), home_{delta.position(Vec3::Zero()), Quat(0, 1, 0, 0)}, count_(count), delta_(delta) {}

Arm Arm::with_tool(const Pose& tool) const noexcept {
  Arm arm = *this;
  if (delta_) {
    arm.tool_ = tool_ * tool;
  } else {
    arm.home_ = home_ * tool;
  }
  arm.end_ = tool.orientation.conjugate() * (end_ - tool.position);
  return arm;
}

Arm Arm::in_world() const noexcept {
  Arm arm = *this;
  std::copy(links_.begin() + world_joint_, links_.end(), arm.links_.begin());
  arm.link_count_ = link_count_ - static_cast<std::size_t>(world_joint_);
  arm.count_ = count_ - world_joint_;
  arm.world_joint_ = 0;
  return arm;
}

bool Arm::turns_six() const noexcept {
  return count_ == 6 && link_count_ == 6 && std::all_of(links_.begin(), links_.begin() + 6, [](const Link& l) {
           return l.kind == AxisKind::Turning && l.ratio == 1;
         });
}

Pose Arm::forward(const Joints& q) const noexcept {
  if (delta_) {
    const double turn = count_ > 3 ? q[3] / 2 : 0;
    return Pose{delta_->position(q.head<3>()), home_.orientation * Quat(std::cos(turn), 0, 0, std::sin(turn))} * tool_;
  }
  Mat3 rotation = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  for (std::size_t i = 0; i < link_count_; ++i) {
    const Link& link = links_[i];
    const double moved = link.ratio * q[link.axis];
    if (link.kind == AxisKind::Sliding) {
      shift += rotation * (moved * link.direction);
      continue;
    }
    const Mat3 turn = turned(link.direction, moved);
    shift += rotation * (link.point - turn * link.point);
    rotation = rotation * turn;
  }
  return {rotation * home_.position + shift, Quat(rotation) * home_.orientation};
}

// The frame after a joint.
ChainFrame Arm::behind(const ChainFrame& before, const Link& link, const Joints& q) noexcept {
  const double moved = link.ratio * q[link.axis];
  if (link.kind == AxisKind::Sliding) {
    return {before.turn, before.shift + before.turn * (moved * link.direction)};
  }
  const Mat3 turn = turned(link.direction, moved);
  return {before.turn * turn, before.shift + before.turn * (link.point - turn * link.point)};
}

ChainFrame Arm::world(const Joints& q) const noexcept {
  ChainFrame frame;
  for (int i = 0; i < world_joint_; ++i) {
    frame = behind(frame, link(i), q);
  }
  return frame;
}

void Arm::frames(const Joints& q, ChainFrames& frames) const noexcept {
  frames[0] = {};
  for (std::size_t i = 0; i < link_count_; ++i) {
    frames[i + 1] = behind(frames[i], links_[i], q);
  }
}

Jacobian Arm::jacobian(const Joints& q, Pose& tool) const noexcept {
  if (delta_) {
    tool = forward(q);
    Jacobian j = Jacobian::Zero();
    j.topLeftCorner<3, 3>() = delta_->moving(q.head<3>());
    if (count_ > 3) {
      const Vec3 down(0, 0, -1);  // axis about which the tool turns
      j.block<3, 1>(0, 3) = down.cross(tool.position - delta_->position(q.head<3>()));
      j.block<3, 1>(3, 3) = down;
    }
    return j;
  }
  std::array<Vec3, kMostLinks> points;
  std::array<Vec3, kMostLinks> directions;
  Mat3 rotation = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  for (std::size_t i = 0; i < link_count_; ++i) {
    const Link& link = links_[i];
    const double moved = link.ratio * q[link.axis];
    directions[i] = rotation * link.direction;
    points[i] = rotation * link.point + shift;
    if (link.kind == AxisKind::Sliding) {
      shift += moved * directions[i];
      continue;
    }
    const Mat3 turn = turned(link.direction, moved);
    shift += rotation * (link.point - turn * link.point);
    rotation = rotation * turn;
  }
  tool = {rotation * home_.position + shift, Quat(rotation) * home_.orientation};
  Jacobian j = Jacobian::Zero();
  for (std::size_t i = 0; i < link_count_; ++i) {
    const Link& link = links_[i];
    if (link.kind == AxisKind::Sliding) {
      j.block<3, 1>(0, link.axis) += link.ratio * directions[i];
    } else {
      j.block<3, 1>(0, link.axis) += link.ratio * directions[i].cross(tool.position - points[i]);
      j.block<3, 1>(3, link.axis) += link.ratio * directions[i];
    }
  }
  return j;
}

// More than six axes: only those count that follow the tool on a path; its command says where the others are.
double Arm::volume(const Joints& q) const noexcept {
  const Jacobian j = jacobian(q);
  if (count_ == 6) {
    return j.leftCols<6>().determinant();
  }
  if (count_ > 6) {
    const Held held = redundant_axes(*this);
    Eigen::Matrix<double, 6, 6> following;
    for (int i = 0, column = 0; i < count_ && column < 6; ++i) {
      if (!holds(held, i)) {
        following.col(column++) = j.col(i);
      }
    }
    return following.determinant();
  }
  Eigen::Matrix<double, kAxes, kAxes> normal = j.transpose() * j;
  normal.diagonal().tail(kAxes - count_).setOnes();
  return std::sqrt(std::max(0.0, normal.determinant()));
}

int Arm::goes_beyond(const Joints& from, const Joints& to, double slack) const noexcept {
  for (int i = 0; i < count_; ++i) {
    const Axis& a = axis(i);
    const bool inside = std::isfinite(to[i]) && to[i] >= std::min(a.lowest(), from[i]) - slack &&
                        to[i] <= std::max(a.highest(), from[i]) + slack;
    if (!inside) {
      return i;
    }
  }
  return -1;
}

int Arm::beyond_limits(const Joints& q, double slack) const noexcept {
  Joints inside = Joints::Zero();
  for (int i = 0; i < count_; ++i) {
    inside[i] = axis(i).lowest();
  }
  return goes_beyond(inside, q, slack);
}

// Additive recurrence.
Joints Arm::spread(int number) const noexcept {
  // Fractional parts of square roots of primes: no two of them, nor their sums, have a common period.
  constexpr double kStride[] = {0.4142135623730951, 0.7320508075688772, 0.2360679774997898, 0.6457513110645907,
                                0.3166247903553998, 0.6055512754639891, 0.1231056256176606, 0.3588989435406740};
  Joints q = Joints::Zero();
  for (int i = 0; i < count_; ++i) {
    const Axis& a = axis(i);
    const double part = std::fmod(0.5 + number * kStride[i], 1.0);
    // One turn is enough.
    const double lower = a.slides() ? a.lower : a.endless ? -kPi : std::max(a.lower, std::min(-kPi, a.upper - 2 * kPi));
    const double upper = a.slides() ? a.upper : a.endless ? kPi : std::min(a.upper, lower + 2 * kPi);
    q[i] = lower + part * (upper - lower);
  }
  return q;
}

}  // namespace indurop::robot
