// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/command_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "control/robot/group/pose_numbers.h"

namespace indurop::robot {

namespace {

bool is_relative(Service service) noexcept {
  return service == Service::DirectRelative || service == Service::LinearRelative ||
         service == Service::CircularRelative;
}
bool is_circle(Service service) noexcept {
  return service == Service::CircularAbsolute || service == Service::CircularRelative;
}

Move move_of(Service service) noexcept {
  if (is_free(service)) {
    return Move::Free;
  }
  if (is_direct(service)) {
    return Move::Joint;
  }
  return is_circle(service) ? Move::Circle : Move::Line;
}

// Whether the velocity is a part of full speed, in percent, as for paths of the joints.
bool is_in_percent(Service service) noexcept {
  return is_direct(service) || is_free(service);
}

// A free motion begins and ends at rest.
bool is_sane_search(const Command& c) noexcept {
  const double seed = c.aux[0];
  const double within = c.aux[1];
  return seed >= 0 && seed <= std::numeric_limits<std::uint32_t>::max() && seed == std::floor(seed) && within >= 0 &&
         within <= kLongestSearch && c.buffer <= BufferMode::Buffered && c.transition == 0;
}

// Returns the point through which a circle passes that is given in another way. The end only determines the direction.
Vec3 circle_mid(const Vec3& from, const Vec3& center, const Vec3& to, const Vec3& up, bool clockwise) noexcept {
  const Vec3 a = from - center;
  const Vec3 b = to - center;
  Vec3 normal = a.cross(b);
  const bool flat = normal.norm() < 1e-9 * a.norm() * b.norm();
  normal = flat ? up : normal;
  const bool agrees = normal.dot(up) >= 0;
  normal = agrees ? normal : Vec3(-normal);
  double angle = std::atan2(normal.normalized().dot(a.cross(b)), a.dot(b));
  angle += angle <= 0 ? 2 * kPi : 0;
  angle -= clockwise ? 2 * kPi : 0;
  return center + Eigen::AngleAxisd(angle / 2, normal.normalized()) * a;
}

// Computes the centre of a circle through two points from the normal of its plane, whose length is the radius; on the
// side of the shorter arc.
bool circle_center(const Vec3& from, const Vec3& to, const Vec3& radius, Vec3& center) noexcept {
  const Vec3 half = (to - from) / 2;
  const double far = radius.squaredNorm() - half.squaredNorm();
  const Vec3 side = radius.cross(half);
  if (!(far >= 0) || side.norm() <= 0 || std::abs(radius.dot(half)) > 1e-6 * radius.norm() * half.norm()) {
    return false;
  }
  center = from + half + side.normalized() * std::sqrt(far);
  return true;
}

}  // namespace

bool is_motion(Service service) noexcept {
  switch (service) {
    case Service::DirectAbsolute:
    case Service::DirectRelative:
    case Service::LinearAbsolute:
    case Service::LinearRelative:
    case Service::CircularAbsolute:
    case Service::CircularRelative:
    case Service::Halt:
    case Service::FreeAbsolute:
      return true;
    default:
      return false;
  }
}

bool is_direct(Service service) noexcept {
  return service == Service::DirectAbsolute || service == Service::DirectRelative;
}

bool is_sane(const Command& c) noexcept {
  const auto finite = [](double x) { return std::isfinite(x); };
  return std::all_of(c.to.begin(), c.to.end(), finite) && std::all_of(c.aux.begin(), c.aux.end(), finite) &&
         c.velocity >= 0 && c.transition >= 0 && finite(c.velocity) && finite(c.transition) &&
         c.buffer >= BufferMode::Aborting && c.buffer <= BufferMode::BlendingHigh && c.coords >= CoordSystem::Axes &&
         c.coords <= CoordSystem::Product && c.acceleration == 0 && c.deceleration == 0 && c.jerk == 0 &&
         (!is_in_percent(group_service_of(c)) || c.velocity <= 100) &&
         (!is_free(group_service_of(c)) || is_sane_search(c));
}

// Converts to the machine's coordinates.
Pose CommandMotion::machine_pose(const std::array<double, 8>& numbers, const Command& command,
                                 const Pose& start) const noexcept {
  const bool product = command.coords == CoordSystem::Product;
  const Pose given = pose_of(numbers);
  const Pose frame = conveyor_.product_ahead();
  if (is_relative(group_service_of(command))) {
    const Quat turn = product ? frame.orientation : Quat::Identity();
    return {start.position + turn * given.position, turn * given.orientation * turn.conjugate() * start.orientation};
  }
  return product ? Pose{frame.position + frame.orientation * given.position, frame.orientation * given.orientation}
                 : given;
}

ErrorCode CommandMotion::make_target(const Command& command, const Pose& start, Target& target) const noexcept {
  const Service service = group_service_of(command);
  if (command.coords != CoordSystem::Axes) {
    target.is_pose = true;
    target.pose = machine_pose(command.to, command, start);
    return ErrorCode::Ok;
  }
  const Joints given = robot_.axes.from_users(command.to.data());
  const Joints q = is_relative(service) ? Joints(conveyor_.planned_end() + given) : given;
  if (robot_.parts.arm.beyond_limits(q) >= 0) {
    return ErrorCode::JointLimit;
  }
  target.is_pose = !is_in_percent(service);
  target.joints = q;
  target.pose = robot_.tip(q);
  return ErrorCode::Ok;
}

ErrorCode CommandMotion::make_circle(const Command& command, const Pose& from, MoveCommand& move) const noexcept {
  constexpr int kClockwise = 16;
  if (command.coords == CoordSystem::Axes) {
    return ErrorCode::Value;
  }
  const bool clockwise = (command.option & kClockwise) != 0;
  const auto mode = static_cast<CircleMode>(command.option & (kClockwise - 1));
  const Vec3& start = from.position;
  const Vec3& end = move.target.pose.position;
  const Quat turn = command.coords == CoordSystem::Product ? conveyor_.product_ahead().orientation : Quat::Identity();
  move.mid.is_pose = true;
  move.mid.pose = machine_pose(command.aux, command, from);
  if (mode == CircleMode::Border) {
    return ErrorCode::Ok;
  }
  Vec3 center = move.mid.pose.position;
  Vec3 up = turn * Vec3::UnitZ();
  if (mode == CircleMode::Radius) {
    up = turn * pose_of(command.aux).position;
    if (!circle_center(start, end, clockwise ? Vec3(-up) : up, center)) {
      return ErrorCode::Circle;
    }
  } else if (mode != CircleMode::Center) {
    return ErrorCode::Value;
  }
  constexpr double kSame = 1e-4;  // m
  if (std::abs((start - center).norm() - (end - center).norm()) > kSame || (start - center).norm() < kSame) {
    return ErrorCode::Circle;
  }
  move.mid.pose.position = circle_mid(start, center, end, up, clockwise);
  return ErrorCode::Ok;
}

ErrorCode CommandMotion::make(const Command& command, const Pose& start, MoveCommand& move) const noexcept {
  const Service service = group_service_of(command);
  move.acceleration = conveyor_.acceleration();
  move.move = move_of(service);
  if (is_free(service)) {
    move.seed = static_cast<std::uint32_t>(command.aux[0]);
    move.within = command.aux[1] == 0 ? kUsualSearch : command.aux[1];
  }
  if (is_in_percent(service)) {
    move.speed = command.velocity == 0 ? 1 : command.velocity / 100;
  } else {
    move.tool_speed = command.velocity / 1000;
  }
  if (const ErrorCode code = make_target(command, start, move.target); code != ErrorCode::Ok) {
    return code;
  }
  return is_circle(service) ? make_circle(command, start, move) : ErrorCode::Ok;
}

}  // namespace indurop::robot
