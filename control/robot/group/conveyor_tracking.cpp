// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/conveyor_tracking.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "control/robot/group/fault_text.h"
#include "control/robot/group/pose_numbers.h"
#include "control/robot/group/torque_now.h"

namespace indurop::robot {

namespace {

constexpr double kLook = 1e-4;      // m or rad along the belt, to determine which joint motion it requires
constexpr double kWay = 0.25;       // part of the joints' accelerations for synchronizing with the belt and leaving it
constexpr double kCatchUp = 0.1;    // m/s or rad/s
constexpr double kMostSpeed = 0.8;  // of a joint, for tracking alone
constexpr double kSlowest = 0.1;    // part of full speed that is left for motions on it
constexpr double kOnProduct = 0.4;  // part of the accelerations that is left for motions on it
constexpr double kFull = 0.95;      // of a joint's speed, for tracking and path together
constexpr double kExact = 1e-6;     // m

// Returns whether an error may result from moving a set point along with the belt.
bool is_of_tracking(ErrorCode code) noexcept {
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

ConveyorTracking::ConveyorTracking(Robot& robot, GroupPort& group, Plans& plans) noexcept
    : robot_(robot), group_(group), plans_(plans), tracking_(robot.period) {
  belts_.fill(BeltEstimator(robot.period));
}

Joints ConveyorTracking::planned_end() const noexcept {
  return robot_.follower.idle() && !on() && !robot_.states.pressing() ? robot_.commanded() : robot_.follower.end();
}

LineLimits ConveyorTracking::most_of(const Tracking::Carrier& carrier) const noexcept {
  const ToolLimits& tool = robot_.parts.tool;
  return carrier.turns ? LineLimits{tool.turn_velocity, tool.turn_acceleration, tool.turn_jerk}
                       : LineLimits{tool.velocity, tool.acceleration, tool.jerk};
}

// Limits of the carrier's motion set by the joints at the present position; false: they cannot follow it at all.
bool ConveyorTracking::room_for(const Tracking::Carrier& carrier, Room& room) const noexcept {
  const Joints now = robot_.commanded();
  const Pose tip = robot_.tip(now);
  std::array<Joints, 2> q;
  for (std::size_t k = 0; k < q.size(); ++k) {
    const double by = k == 0 ? -kLook : kLook;
    const Inverse::Result result =
        robot_.tool.inverse().nearest(Tracking::carried(carrier, by, tip), robot_.tool.inverse().held_as(now, now));
    if (result.reach != Reach::Ok) {
      return false;
    }
    q[k] = result.solution.q;
  }
  room.limits = most_of(carrier);
  for (int i = 0; i < robot_.count(); ++i) {
    const double rate = std::abs(q[1][i] - q[0][i]) / (2 * kLook);
    if (rate > 0) {
      room.limits.velocity = std::min(room.limits.velocity, robot_.parts.joints.velocity[i] / rate);
      room.limits.acceleration = std::min(room.limits.acceleration, robot_.parts.joints.acceleration[i] / rate);
      room.limits.jerk = std::min(room.limits.jerk, robot_.parts.joints.jerk[i] / rate);
    }
  }
  TipSpeed speed(robot_.tool.arm());
  speed.begin(q[0]);
  speed.note(q[1]);
  room.tip = speed.farthest() / (2 * kLook);
  return true;
}

// Sets the product's coordinates in those of the machine.
ErrorCode ConveyorTracking::set_product(const Command& command) noexcept {
  if (!std::all_of(command.to.begin(), command.to.begin() + 6, [](double x) { return std::isfinite(x); })) {
    return ErrorCode::Value;
  }
  end_tracking();
  tracking_.forget();
  product_lost_ = false;
  product_ = pose_of(command.to);
  std::copy_n(command.to.begin(), product_given_.size(), product_given_.begin());
  return ErrorCode::Ok;
}

// The product's coordinates move with a belt from now on.
ErrorCode ConveyorTracking::track(const Command& command, bool turns) noexcept {
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(command.to.begin(), command.to.begin() + 6, finite) ||
      !std::all_of(command.aux.begin(), command.aux.begin() + 6, finite) || command.option < 1 ||
      command.option > static_cast<int>(kBelts)) {
    return ErrorCode::Value;
  }
  if (robot_.states.pressing()) {
    return ErrorCode::State;
  }
  return track({turns, command.option - 1, pose_of(command.to), pose_of(command.aux)});
}

ErrorCode ConveyorTracking::track(const Tracking::Carrier& carrier) noexcept {
  if (robot_.parts.arm.world_joint() > 0) {
    robot_.job.set_message(
        "belts and tables cannot be tracked while axes move the workpiece (<workpiece> of the URDF)");
    return ErrorCode::Belt;
  }
  const BeltEstimator& belt = belts_[at(carrier.belt)];
  if (!belt.known()) {
    FaultText why;
    std::snprintf(why, sizeof why,
                  "belt %d has no position: its reader has to write MC_BELT[%d] in each period, for 0.4 s",
                  carrier.belt + 1, carrier.belt);
    robot_.job.set_message(why);
    return ErrorCode::Belt;
  }
  end_tracking();
  tracking_.set(carrier, belt);
  product_lost_ = false;
  return ErrorCode::Ok;
}

void ConveyorTracking::release() noexcept {
  end_tracking();
  tracking_.forget();
  product_lost_ = false;
}

// Called before the product's coordinates change: the tool comes to rest, and motions on the product are discarded.
void ConveyorTracking::end_tracking() noexcept {
  if (tracking_.on() && robot_.states.moving()) {
    group_.forget_plans();
    robot_.follower.stop();
    leave(false);
  }
}

void ConveyorTracking::sense(const std::array<BeltIn, kBelts>& belts) noexcept {
  for (std::size_t k = 0; k < belts_.size(); ++k) {
    belts_[k].sense(belts[k]);
  }
  if (tracking_.known() && !belt().known()) {
    lose_product(belt().jumped() ? "jumped" : "has no position any more");
  }
}

// Whatever moves the tool fails because of the belt.
void ConveyorTracking::end_motion(ErrorCode code, const char* why) noexcept {
  if (robot_.job.running()) {
    robot_.job.fail({code}, why, JobRunner::kReported);
    group_.finish_service(code);
  }
  group_.drop_motions(code);
  group_.stop_for(Fault{code});
}

// The tool comes to rest on its own, without the belt.
void ConveyorTracking::lose_product(const char* why) noexcept {
  FaultText text;
  std::snprintf(text, sizeof text, "belt %d %s: check its encoder and its reader, then track it again",
                tracking_.carrier().belt + 1, why);
  tracking_.forget();
  product_lost_ = true;
  const bool moves_tool = tracking_.on() && robot_.states.moving();
  const bool by_job = robot_.job.running();
  if (moves_tool) {
    end_motion(ErrorCode::Belt, text);
  }
  leave(false);
  if (!(moves_tool && by_job)) {
    robot_.job.set_message(text);  // otherwise the message names the line, too
  }
}

ErrorCode ConveyorTracking::join() noexcept {
  Room room;
  if (!room_for(tracking_.carrier(), room)) {
    return ErrorCode::Unreachable;
  }
  const double speed = std::abs(tracking_.belt(belt()).velocity);
  const LineLimits& limits = room.limits;
  if (speed > kMostSpeed * limits.velocity || speed * room.tip > group_.tip_limit()) {
    return ErrorCode::Speed;
  }
  LineLimits most = most_of(tracking_.carrier());
  most.velocity = std::min(most.velocity, group_.tip_limit() / std::max(room.tip, 1e-9));
  // Catches up slowly with a product that has moved on: further along, the arm may not be able to do as much as here.
  const double most_speed = std::min({limits.velocity / 2, most.velocity, 2 * speed + kCatchUp});
  tracking_.join(belt(), {most_speed, kWay * limits.acceleration, kWay * limits.jerk}, most);
  return ErrorCode::Ok;
}

void ConveyorTracking::leave(bool stays) noexcept {
  if (!tracking_.on() || (tracking_.leaves() && stays)) {
    return;
  }
  Room room;
  room.limits = most_of(tracking_.tracked());
  room_for(tracking_.tracked(), room);
  held_ = stays;
  tracking_.leave({room.limits.velocity, kWay * room.limits.acceleration, kWay * room.limits.jerk}, stays);
}

bool ConveyorTracking::reaches(bool on_product, ErrorCode& error) noexcept {
  const bool wanted = tracking_.known() && on_product;
  if (!wanted && !tracking_.on()) {
    return true;
  }
  if (!robot_.follower.idle()) {
    return wanted && tracking_.is_synchronized();  // also planned from where the one before begins
  }
  if (!wanted) {
    leave(false);
  } else if (!tracking_.on() && !paused_) {
    error = join();
  }
  if (!wanted || !tracking_.is_synchronized() || plans_.holds_forgotten()) {
    return false;
  }
  keep_to_product();
  return true;
}

// The tool is at rest on the product: later motions are planned from there. The path may use the joint speed that
// tracking leaves.
void ConveyorTracking::keep_to_product() noexcept {
  tracking_.anchor();
  robot_.follower.reset(robot_.commanded());
  Room room;
  if (!room_for(tracking_.tracked(), room)) {
    return;
  }
  const double speed = std::abs(tracking_.belt(belt()).velocity);
  pace_ = std::clamp(kFull - speed / room.limits.velocity, kSlowest, 1.0);
  speed_ = speed * room.tip;
}

double ConveyorTracking::acceleration() const noexcept {
  return tracking_.is_synchronized() ? kOnProduct : 1;
}

// The product's pose for the motion that is being planned.
Pose ConveyorTracking::product_ahead() const noexcept {
  return tracking_.is_synchronized() ? tracking_.product(tracking_.anchored() - tracking_.lag()) : product_;
}

// A hold also stops tracking, which later continues at the same place on the product. Any other stop ends it.
void ConveyorTracking::steer() noexcept {
  if (!robot_.states.moving()) {
    leave(false);
  } else if (paused_) {
    leave(true);
  } else if (held_ && tracking_.leaves() && tracking_.known()) {
    held_ = false;
    if (const ErrorCode code = join(); code != ErrorCode::Ok) {
      end_motion(code, to_string(code));
      leave(false);
    }
  }
}

// The set point of this period, computed from that of the path.
Fault ConveyorTracking::carry(Joints& q) noexcept {
  if (!tracking_.on()) {
    return {};
  }
  steer();
  if (tracking_.step(belt()) != ErrorCode::Ok) {
    lose_product("is too quick for the tool, or starts and stops too suddenly");
    tracking_.step(belt());
  }
  const Pose pose = tracking_.carried(robot_.tip(q));
  const Inverse::Result result =
      robot_.tool.inverse().nearest(pose, robot_.tool.inverse().held_as(q, robot_.commanded()));
  if (result.reach != Reach::Ok) {
    return {code_of(result.reach)};
  }
  q = result.solution.q;
  if ((robot_.tip(q).position - pose.position).norm() > kExact) {
    return {ErrorCode::Unreachable};
  }
  // The path was planned where the product was; where the belt moves it, the arm may need more torque.
  if (const Fault heavy = too_heavy(robot_, q); !heavy.ok()) {
    return heavy;
  }
  if (tracking_.leaves() && tracking_.at_rest() && robot_.follower.idle() && !held_) {
    tracking_.drop();
    robot_.follower.reset(q);
    pace_ = 1;
    speed_ = 0;
  }
  return {};
}

// Ends tracking when axes stop on their own.
void ConveyorTracking::drop(ErrorCode code) noexcept {
  if (!tracking_.on()) {
    return;
  }
  if (is_of_tracking(code)) {
    FaultText why;
    std::snprintf(why, sizeof why, "the tool no longer follows belt %d: %s; run the belt slower or nearer to the arm",
                  tracking_.tracked().belt + 1, to_string(code));
    robot_.job.set_message(why);
  }
  tracking_.drop();
  held_ = false;
  pace_ = 1;
  speed_ = 0;
}

void ConveyorTracking::update_product() noexcept {
  if (!tracking_.known()) {
    return;
  }
  const double place = tracking_.belt(belt()).position;
  product_ = tracking_.product(tracking_.is_synchronized() ? tracking_.place() - tracking_.lag() : place);
  const Vec3 rpy = to_rpy(product_.orientation);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    product_given_[k] = 1000 * product_.position[i];
    product_given_[k + 3] = degrees(rpy[i]);
  }
}

}  // namespace indurop::robot
