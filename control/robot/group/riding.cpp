// SPDX-License-Identifier: Apache-2.0
// Products that move with a conveyor or a rotary table. A motion in the product's coordinates is planned as if the
// product were where it was when the tool was last at rest on it; each set point is then moved along with the belt.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "control/robot/group/group.h"

namespace indurop::robot {

namespace {

constexpr double kLook = 1e-4;      // m or rad along the belt, to determine which joint motion it requires
constexpr double kWay = 0.25;       // part of the joints' accelerations for synchronizing with the belt and leaving it
constexpr double kCatchUp = 0.1;    // m/s or rad/s
constexpr double kMostSpeed = 0.8;  // of a joint, for tracking alone
constexpr double kSlowest = 0.1;    // part of full speed that is left for motions on it
constexpr double kFull = 0.95;      // of a joint's speed, for tracking and path together
constexpr double kExact = 1e-6;     // m

// Returns whether an error may result from moving a set point along with the belt.
bool is_by_ride(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::Unreachable:
    case ErrorCode::JointLimit:
    case ErrorCode::Singular:
    case ErrorCode::Speed:
    case ErrorCode::Acceleration:
    case ErrorCode::Jerk:
    case ErrorCode::Workspace:
    case ErrorCode::Torque:
      return true;
    default:
      return false;
  }
}

}  // namespace

LineLimits Group::most_of(const Tracking::Carrier& carrier) const noexcept {
  const ToolLimits& tool = parts_.tool;
  return carrier.turns ? LineLimits{tool.turn_velocity, tool.turn_acceleration, tool.turn_jerk}
                       : LineLimits{tool.velocity, tool.acceleration, tool.jerk};
}

// Limits of the carrier's motion set by the joints at the present position; false: they cannot follow it at all.
bool Group::room_to_ride(const Tracking::Carrier& carrier, RideRoom& room) const noexcept {
  const Joints now = commanded();
  const Pose tip = places_.arm().forward(now);
  std::array<Joints, 2> q;
  for (std::size_t k = 0; k < q.size(); ++k) {
    const double by = k == 0 ? -kLook : kLook;
    const Inverse::Result result =
        places_.inverse().nearest(Tracking::carried(carrier, by, tip), places_.inverse().held_as(now, now));
    if (result.reach != Reach::Ok) {
      return false;
    }
    q[k] = result.solution.q;
  }
  room.limits = most_of(carrier);
  for (int i = 0; i < count(); ++i) {
    const double rate = std::abs(q[1][i] - q[0][i]) / (2 * kLook);
    if (rate > 0) {
      room.limits.velocity = std::min(room.limits.velocity, parts_.joints.velocity[i] / rate);
      room.limits.acceleration = std::min(room.limits.acceleration, parts_.joints.acceleration[i] / rate);
      room.limits.jerk = std::min(room.limits.jerk, parts_.joints.jerk[i] / rate);
    }
  }
  TipSpeed speed(places_.arm());
  speed.begin(q[0]);
  speed.note(q[1]);
  room.tip = speed.farthest() / (2 * kLook);
  return true;
}

// The product's coordinates move with a belt from now on.
ErrorCode Group::track(const Command& command, bool turns) noexcept {
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(command.to.begin(), command.to.begin() + 6, finite) ||
      !std::all_of(command.aux.begin(), command.aux.begin() + 6, finite) || command.option < 1 ||
      command.option > static_cast<int>(kBelts)) {
    return ErrorCode::Value;
  }
  const Tracking::Carrier carrier{turns, command.option - 1, pose_of(command.to), pose_of(command.aux)};
  const BeltWatch& watch = belts_[static_cast<std::size_t>(carrier.belt)];
  if (!watch.known()) {
    char why[kWhy];
    std::snprintf(why, sizeof why, "belt %d is not told: its reader has to write MC_BELT[%d] in each period, for 0.4 s",
                  carrier.belt + 1, carrier.belt);
    job_.say(why);
    return ErrorCode::Belt;
  }
  get_off();
  tracking_.set(carrier, watch);
  product_lost_ = false;
  return ErrorCode::Ok;
}

// Called before the product's coordinates change: the tool comes to rest, and motions on the product are discarded.
void Group::get_off() noexcept {
  if (tracking_.on() && state_ == GroupState::Moving) {
    forget_plans();
    follower_.stop();
    leave_belt(false);
  }
}

void Group::sense_belts(const Inputs& in) noexcept {
  for (std::size_t k = 0; k < belts_.size(); ++k) {
    belts_[k].sense(in.belts[k]);
  }
  if (tracking_.known() && !belt_watch().known()) {
    lose_product(belt_watch().jumped() ? "jumped" : "is not told any more");
  }
}

// The tool comes to rest on its own, without the belt.
void Group::lose_product(const char* why) noexcept {
  char text[kWhy];
  std::snprintf(text, sizeof text, "belt %d %s: see to its encoder and its reader, then track it anew",
                tracking_.carrier().belt + 1, why);
  tracking_.forget();
  product_lost_ = true;
  if (tracking_.on() && state_ == GroupState::Moving) {
    drop_motions(ErrorCode::Belt);
    stop_for(Fault{ErrorCode::Belt});
  }
  leave_belt(false);
  job_.say(text);
}

ErrorCode Group::get_on() noexcept {
  RideRoom room;
  if (!room_to_ride(tracking_.carrier(), room)) {
    return ErrorCode::Unreachable;
  }
  const double speed = std::abs(tracking_.belt(belt_watch()).velocity);
  const LineLimits& limits = room.limits;
  if (speed > kMostSpeed * limits.velocity || speed * room.tip > tip_limit()) {
    return ErrorCode::Speed;
  }
  LineLimits most = most_of(tracking_.carrier());
  most.velocity = std::min(most.velocity, tip_limit() / std::max(room.tip, 1e-9));
  // Catches up slowly with a product that has moved on: further along, the arm may not be able to do as much as here.
  const double most_speed = std::min({limits.velocity / 2, most.velocity, 2 * speed + kCatchUp});
  tracking_.join(belt_watch(), {most_speed, kWay * limits.acceleration, kWay * limits.jerk}, most);
  return ErrorCode::Ok;
}

void Group::leave_belt(bool stays) noexcept {
  if (!tracking_.on() || (tracking_.leaves() && stays)) {
    return;
  }
  RideRoom room;
  room.limits = most_of(tracking_.ridden());
  room_to_ride(tracking_.ridden(), room);
  ride_held_ = stays;
  tracking_.leave({room.limits.velocity, kWay * room.limits.acceleration, kWay * room.limits.jerk}, stays);
}

// Returns whether the tool is at the reference of the motion: at rest on the product, or off any.
bool Group::is_on_product(int ticket) noexcept {
  const bool wanted = tracking_.known() && table_.command(ticket).coords == CoordSystem::Product;
  if (wanted == tracking_.on() && !wanted) {
    return true;
  }
  if (!follower_.idle()) {
    return wanted && tracking_.rides();  // also planned from where the one before begins
  }
  if (!wanted) {
    leave_belt(false);
  } else if (!tracking_.on() && !paused_) {
    if (const ErrorCode code = get_on(); code != ErrorCode::Ok) {
      fail_motions(ticket, code);
    }
  }
  if (!wanted || !tracking_.rides() || desk_.holds_forgotten()) {
    return false;
  }
  keep_to_product();
  return true;
}

// The tool is at rest on the product: later motions are planned from there. The path may use the joint speed that
// tracking leaves.
void Group::keep_to_product() noexcept {
  tracking_.anchor();
  follower_.reset(commanded());
  RideRoom room;
  if (!room_to_ride(tracking_.ridden(), room)) {
    return;
  }
  const double speed = std::abs(tracking_.belt(belt_watch()).velocity);
  ride_pace_ = std::clamp(kFull - speed / room.limits.velocity, kSlowest, 1.0);
  ride_speed_ = speed * room.tip;
}

// The product's pose for the motion that is being planned.
Pose Group::product_ahead() const noexcept {
  return tracking_.rides() ? tracking_.product(tracking_.anchored() - tracking_.lag()) : product_;
}

// A hold also stops tracking, which later continues at the same place on the product. Any other stop ends it.
void Group::steer_ride() noexcept {
  if (state_ != GroupState::Moving) {
    leave_belt(false);
  } else if (paused_) {
    leave_belt(true);
  } else if (ride_held_ && tracking_.leaves() && tracking_.known()) {
    ride_held_ = false;
    if (const ErrorCode code = get_on(); code != ErrorCode::Ok) {
      drop_motions(code);
      stop_for(Fault{code});
      leave_belt(false);
    }
  }
}

// The set point of this period, computed from that of the path.
Fault Group::ride(Joints& q) noexcept {
  if (!tracking_.on()) {
    return {};
  }
  steer_ride();
  if (tracking_.step(belt_watch()) != ErrorCode::Ok) {
    lose_product("is too quick for the tool, or starts and stops too suddenly");
    tracking_.step(belt_watch());
  }
  const Pose pose = tracking_.carried(places_.arm().forward(q));
  const Inverse::Result result = places_.inverse().nearest(pose, places_.inverse().held_as(q, commanded()));
  if (result.reach != Reach::Ok) {
    return {result.reach == Reach::JointLimit   ? ErrorCode::JointLimit
            : result.reach == Reach::OutOfReach ? ErrorCode::Unreachable
                                                : ErrorCode::Singular};
  }
  q = result.solution.q;
  if ((places_.arm().forward(q).position - pose.position).norm() > kExact) {
    return {ErrorCode::Unreachable};
  }
  if (const Fault heavy = too_heavy(q); !heavy.ok()) {
    return heavy;
  }
  if (tracking_.leaves() && tracking_.at_rest() && follower_.idle() && !ride_held_) {
    tracking_.drop();
    follower_.reset(q);
    ride_pace_ = 1;
    ride_speed_ = 0;
  }
  return {};
}

// Returns whether an axis has not enough torque there. The path was planned for the arm where the product was; the belt
// moves it to where it may need more torque.
Fault Group::too_heavy(const Joints& q) const noexcept {
  if (!dynamics_.limited()) {
    return {};
  }
  const Joints velocity = (q - last_command_) / period_;
  const Joints acceleration = (velocity - last_speed_) / period_;
  const Joints needed = dynamics_.torques(q, velocity, acceleration) + dynamics_.friction(velocity);
  for (int i = 0; i < count(); ++i) {
    const double most = dynamics_.effort()[i];
    if (most > 0 && std::abs(needed[i]) > most) {
      return {ErrorCode::Torque, i + 1};
    }
  }
  return {};
}

// Ends tracking when axes stop on their own.
void Group::drop_ride(ErrorCode code) noexcept {
  if (!tracking_.on()) {
    return;
  }
  if (is_by_ride(code)) {
    char why[kWhy];
    std::snprintf(why, sizeof why, "the tool fell off belt %d: %s; ride slower, nearer", tracking_.ridden().belt + 1,
                  to_string(code));
    job_.say(why);
  }
  tracking_.drop();
  ride_held_ = false;
  ride_pace_ = 1;
  ride_speed_ = 0;
}

void Group::report_product() noexcept {
  if (!tracking_.known()) {
    return;
  }
  const double place = tracking_.belt(belt_watch()).position;
  product_ = tracking_.product(tracking_.rides() ? tracking_.place() - tracking_.lag() : place);
  const Vec3 rpy = to_rpy(product_.orientation);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    product_given_[k] = 1000 * product_.position[i];
    product_given_[k + 3] = degrees(rpy[i]);
  }
}

}  // namespace indurop::robot
