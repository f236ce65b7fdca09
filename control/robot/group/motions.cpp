// SPDX-License-Identifier: Apache-2.0
// Motions of the group by commands: one after another, or replacing earlier ones at once. The first ones have been
// given to the planner; the motion that the follower executes determines which of them are done.

#include <algorithm>
#include <cmath>

#include "control/robot/group/group.h"

namespace indurop::robot {

namespace {

constexpr double kOnProduct = 0.4;  // part of the accelerations that tracking leaves for motions on the product

Service service_of(const Command& command) noexcept {
  return static_cast<Service>(command.code);
}

bool is_relative(Service service) noexcept {
  return service == Service::DirectRelative || service == Service::LinearRelative ||
         service == Service::CircularRelative;
}
bool is_direct(Service service) noexcept {
  return service == Service::DirectAbsolute || service == Service::DirectRelative;
}
bool is_circle(Service service) noexcept {
  return service == Service::CircularAbsolute || service == Service::CircularRelative;
}

// The number by which the planner and the follower know a motion; motions of jobs have positive ones.
int source_of(int ticket) noexcept {
  return -ticket - 1;
}

bool sane(const Command& c) noexcept {
  const auto finite = [](double x) { return std::isfinite(x); };
  return std::all_of(c.to.begin(), c.to.end(), finite) && std::all_of(c.aux.begin(), c.aux.end(), finite) &&
         c.velocity >= 0 && c.transition >= 0 && finite(c.velocity) && finite(c.transition) &&
         c.buffer >= BufferMode::Aborting && c.buffer <= BufferMode::BlendingHigh && c.coords >= CoordSystem::Axes &&
         c.coords <= CoordSystem::Product && c.acceleration == 0 && c.deceleration == 0 && c.jerk == 0 &&
         (!is_direct(service_of(c)) || c.velocity <= 100);
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

Pose Group::pose_of(const std::array<double, 8>& numbers) noexcept {
  const Eigen::Map<const Eigen::Matrix<double, 6, 1>, Eigen::Unaligned> six(numbers.data());
  return {six.head<3>() / 1000, from_rpy(six.tail<3>() * (kPi / 180))};
}

Joints Group::joints_of_axes(const std::array<double, 8>& numbers) const noexcept {
  Joints q = Joints::Zero();
  for (int i = 0; i < count(); ++i) {
    q[i] = numbers[at(i)] * axes_[at(i)].unit();
  }
  return q;
}

// Converts to the machine's coordinates. `from`: where a relative motion begins.
Pose Group::pose_of(const std::array<double, 8>& numbers, const Command& command, const Pose& from) const noexcept {
  const bool product = command.coords == CoordSystem::Product;
  const Pose given = pose_of(numbers);
  const Pose frame = product_ahead();
  if (is_relative(service_of(command))) {
    const Quat turn = product ? frame.orientation : Quat::Identity();
    return {from.position + turn * given.position, turn * given.orientation * turn.conjugate() * from.orientation};
  }
  return product ? Pose{frame.position + frame.orientation * given.position, frame.orientation * given.orientation}
                 : given;
}

ErrorCode Group::make_target(const Command& command, const std::array<double, 8>& numbers,
                             Target& target) const noexcept {
  const Service service = service_of(command);
  if (command.coords != CoordSystem::Axes) {
    target.is_pose = true;
    target.pose = pose_of(numbers, command, ahead_of_);
    return ErrorCode::Ok;
  }
  const Joints given = joints_of_axes(numbers);
  const Joints q = is_relative(service) ? Joints(planned_end() + given) : given;
  if (parts_.arm.beyond_limits(q) >= 0) {
    return ErrorCode::JointLimit;
  }
  target.is_pose = !is_direct(service);
  target.joints = q;
  target.pose = places_.arm().forward(q);
  return ErrorCode::Ok;
}

ErrorCode Group::make_circle(const Command& command, MoveCommand& move) const noexcept {
  constexpr int kClockwise = 16;
  if (command.coords == CoordSystem::Axes) {
    return ErrorCode::Value;
  }
  const bool clockwise = (command.option & kClockwise) != 0;
  const auto mode = static_cast<CircleMode>(command.option & (kClockwise - 1));
  const Vec3& start = ahead_of_.position;
  const Vec3& end = move.target.pose.position;
  const Quat turn = command.coords == CoordSystem::Product ? product_ahead().orientation : Quat::Identity();
  move.mid.is_pose = true;
  move.mid.pose = pose_of(command.aux, command, ahead_of_);
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

ErrorCode Group::make_motion(int ticket, MoveCommand& move) const noexcept {
  const Command& command = table_.command(ticket);
  const Service service = service_of(command);
  move.source = source_of(ticket);
  move.acceleration = tracking_.rides() ? kOnProduct : 1;
  move.move = is_direct(service) ? Move::Joint : is_circle(service) ? Move::Circle : Move::Line;
  if (is_direct(service)) {
    move.speed = command.velocity == 0 ? 1 : command.velocity / 100;
  } else {
    move.tool_speed = command.velocity / 1000;
  }
  if (const ErrorCode code = make_target(command, command.to, move.target); code != ErrorCode::Ok) {
    return code;
  }
  return is_circle(service) ? make_circle(command, move) : ErrorCode::Ok;
}

void Group::queue_motion(int ticket) noexcept {
  const Command& command = table_.command(ticket);
  ErrorCode code = may_move();
  if (code == ErrorCode::Ok && active_ && state_ == GroupState::Moving) {
    code = ErrorCode::State;  // a service is moving it
  }
  if (code == ErrorCode::Ok && !sane(command)) {
    code = ErrorCode::Value;
  }
  if (code == ErrorCode::Ok && product_lost_ && command.coords == CoordSystem::Product) {
    code = ErrorCode::Belt;
  }
  if (code != ErrorCode::Ok) {
    table_.end(ticket, code);
    return;
  }
  if (command.buffer == BufferMode::Aborting) {
    replace_motions(ticket);
    return;
  }
  motions_[at(motion_count_++)] = ticket;
  begin_moving();
}

void Group::begin_moving() noexcept {
  if (state_ == GroupState::Standby) {
    drop_aside();  // an interrupted job is not continued after other motions
    follower_.reset(commanded());
    last_command_ = commanded();
    state_ = GroupState::Moving;
  }
}

// Joint motions start from any motion of the joints; for a line or circle it first has to come to rest on the path.
void Group::replace_motions(int ticket) noexcept {
  const Command& command = table_.command(ticket);
  const bool joints = is_direct(service_of(command)) && command.coords == CoordSystem::Axes && !follower_.stopping();
  if (joints && !follower_.idle() && !tracking_.on()) {
    ahead_of_ = {};
    MoveCommand move;
    const Joints given = joints_of_axes(command.to);
    const Joints to = service_of(command) == Service::DirectRelative ? Joints(commanded() + given) : given;
    const int beyond = parts_.arm.beyond_limits(to);
    Segment segment = Segment::together_to(to, command.velocity == 0 ? 1 : command.velocity / 100);
    segment.source = source_of(ticket);
    const Fault fault = beyond >= 0 ? Fault{ErrorCode::JointLimit, beyond + 1} : follower_.redirect(segment);
    if (!fault.ok()) {
      table_.end(ticket, fault.code);
      return;
    }
    forget_plans();
    fed_ = 1;
  } else {
    forget_plans();
    follower_.stop();
  }
  interrupted_ = false;
  end_interrupt(ErrorCode::Aborted);
  motions_[0] = ticket;
  motion_count_ = 1;
  begin_moving();
}

// Distance before its end at which it may blend into the next one.
double Group::zone_of(int i) const noexcept {
  if (i + 1 >= motion_count_) {
    return 0;
  }
  const Command& next = table_.command(motions_[at(i + 1)]);
  const auto on_product = [](const Command& c) { return c.coords == CoordSystem::Product; };
  if (tracking_.known() && on_product(next) != on_product(table_.command(motions_[at(i)]))) {
    return 0;  // in between, the tool synchronizes with the product or leaves it
  }
  return next.buffer >= BufferMode::BlendingLow && service_of(next) != Service::Halt ? next.transition / 1000 : 0;
}

// Plans the motion that is followed, and the next one.
void Group::feed_motions() noexcept {
  constexpr int kAhead = 2;
  bool goes_on = false;
  while (fed_ < motion_count_ &&
         (goes_on ? ahead_.has_room() : fed_ < kAhead && ahead_.empty() && desk_.free() && follower_.has_room())) {
    const int ticket = motions_[at(fed_)];
    if (service_of(table_.command(ticket)) == Service::Halt) {
      halt(ticket);
      return;
    }
    if (!goes_on && !is_on_product(ticket)) {
      return;
    }
    if (!goes_on) {
      ahead_of_ = places_.arm().forward(planned_end());
    }
    MoveCommand move;
    if (const ErrorCode code = make_motion(ticket, move); code != ErrorCode::Ok) {
      fail_motions(ticket, code);
      return;
    }
    move.zone = zone_of(fed_);
    ahead_.add(move);
    ahead_of_ = move.target.is_pose ? move.target.pose : places_.arm().forward(move.target.joints);
    ++fed_;
    goes_on = move.zone > 0 && fed_ < motion_count_ && table_.command(motions_[at(fed_)]).coords != CoordSystem::Axes;
  }
}

// Executes a halt when it is its turn.
void Group::halt(int ticket) noexcept {
  if (fed_ > 0) {
    return;
  }
  table_.active(ticket);
  follower_.stop();
  leave_belt(false);
  if (follower_.idle() && !tracking_.on()) {
    end_first(1, ErrorCode::Ok);
  }
}

void Group::note_progress() noexcept {
  if (interrupt_ != CommandTable::kNone && follower_.at_rest() && tracking_.at_rest()) {
    end_interrupt(ErrorCode::Ok);
  }
  if (fed_ == 0) {
    return;
  }
  const bool waiting = follower_.idle();
  const int present = waiting ? (desk_.free() && ahead_.empty() ? 0 : asked_) : follower_.source();
  int done = fed_;
  for (int i = 0; i < fed_ && present != 0; ++i) {
    if (source_of(motions_[at(i)]) == present) {
      done = i;
      break;
    }
  }
  if (present != 0 && done == fed_) {
    return;
  }
  if (tracking_.on() && !tracking_.rides()) {
    done = 0;  // it has not arrived as long as the tool is not on the belt
  }
  end_first(done, ErrorCode::Ok);
  if (fed_ > 0 && !waiting) {
    interrupted_ ? table_.waits(motions_[0]) : table_.active(motions_[0]);
  }
}

void Group::end_first(int many, ErrorCode code) noexcept {
  for (int i = 0; i < many; ++i) {
    table_.end(motions_[at(i)], code);
  }
  std::copy(motions_.begin() + many, motions_.begin() + motion_count_, motions_.begin());
  motion_count_ -= many;
  fed_ = std::max(0, fed_ - many);
}

// Ends a motion that is not possible, and those after it, whose start is no longer defined.
void Group::fail_motions(int ticket, ErrorCode code) noexcept {
  int i = 0;
  while (i < motion_count_ && motions_[at(i)] != ticket) {
    ++i;
  }
  for (int k = i; k < motion_count_; ++k) {
    table_.end(motions_[at(k)], k == i ? code : ErrorCode::Aborted);
  }
  motion_count_ = i;
  fed_ = std::min(fed_, i);
  ahead_.clear();
}

void Group::drop_motions(ErrorCode first) noexcept {
  for (int k = 0; k < motion_count_; ++k) {
    table_.end(motions_[at(k)], k == 0 ? first : ErrorCode::Aborted);
  }
  motion_count_ = fed_ = 0;
}

void Group::forget_plans() noexcept {
  drop_motions(ErrorCode::Aborted);
  interrupted_ = false;
  end_interrupt(ErrorCode::Aborted);
  desk_.forget();
  return_ = Return::None;
  if (!aside_) {
    ahead_.clear();
  }
}

}  // namespace indurop::robot
