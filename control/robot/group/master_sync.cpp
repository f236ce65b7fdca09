// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/master_sync.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "control/robot/group/command_motion.h"

namespace indurop::robot {

namespace {

constexpr double kMostRatio = 1e6;
constexpr double kMillimetre = 0.001;
constexpr double kInStep = 0.001;     // m, distance from the wanted place that counts as none
constexpr double kPull = 3;           // 1/s, rate at which a distance is made up for
constexpr double kPush = 10;          // 1/s, the same for a path that is ahead
constexpr double kSyncAhead = 0.25;   // s that a change of speed takes, about
constexpr double kBeginning = 0.2;    // part of full speed at which a path begins before more is known
constexpr double kLeastShare = 0.01;  // of the tool's full speed: slower places count as that fast

// Returns the speed of the tool in m/s that full speed is where it will be in `seconds`; 0: it is not known.
double speed_ahead(const Follower& follower, double seconds, const Arm& arm) noexcept {
  constexpr double kStep = 0.002;  // s
  const FollowedPath& path = follower.path();
  const double rate = path.segment().timed ? 1 : path.piece_limits().velocity;
  const double by = std::min(rate * kStep, path.left());
  const double ahead = std::min(path.state().velocity * seconds, path.left() - by);
  Joints one = follower.joints();
  Joints other = one;
  if (!(by > 0) || path.joints_ahead(ahead, follower.joints(), one) != Reach::Ok ||
      path.joints_ahead(ahead + by, one, other) != Reach::Ok) {
    return 0;
  }
  return (arm.forward(other).position - arm.forward(one).position).norm() * rate / by;
}

}  // namespace

MasterSync::Master MasterSync::master() const noexcept {
  if (axis_ >= 0) {
    const AxisControl& a = robot_.singles[axis_];
    return {a.commanded().position / a.unit(), a.commanded().velocity / a.unit(),
            a.leads() ? ErrorCode::Ok : ErrorCode::Master};
  }
  const BeltEstimator& belt = conveyor_.belt(belt_);
  return {belt.now().position, belt.now().velocity, belt.known() ? ErrorCode::Ok : ErrorCode::Belt};
}

ErrorCode MasterSync::check(const Command& command) const noexcept {
  const double ratio = command.to[0] / command.to[1];
  const int first = robot_.count() + 1;
  const bool axis = command.option >= first && command.option < first + robot_.singles.count() && command.job == 0;
  const bool belt = command.option == 0 && command.job >= 1 && command.job <= static_cast<int>(kBelts);
  if (!(axis || belt) || !(std::abs(ratio) <= kMostRatio) || ratio == 0 || !(command.to[2] >= 0) ||
      !std::isfinite(command.to[2]) || command.buffer != BufferMode::Aborting) {
    return ErrorCode::Value;
  }
  const bool ready = robot_.states.is(GroupState::Standby) || robot_.states.moving();
  return ready && !conveyor_.on() ? ErrorCode::Ok : ErrorCode::State;
}

void MasterSync::take(int ticket) noexcept {
  const Command& command = robot_.table.command(ticket);
  ErrorCode code = check(command);
  if (code == ErrorCode::Ok) {
    const auto before = std::pair(axis_, belt_);
    axis_ = command.option - robot_.count() - 1;
    axis_ = command.job > 0 ? -1 : axis_;
    belt_ = command.job > 0 ? command.job - 1 : 0;
    code = master().code;
    if (code != ErrorCode::Ok) {
      std::tie(axis_, belt_) = before;
    }
  }
  if (code != ErrorCode::Ok) {
    robot_.table.end(ticket, code);
    return;
  }
  end(ErrorCode::Aborted);
  ticket_ = ticket;
  ends_ = false;
  ratio_ = command.to[0] / command.to[1] * kMillimetre;
  most_ = command.to[2] > 0 ? command.to[2] * kMillimetre : HUGE_VAL;
  seen_ = master().place;
  wanted_ = robot_.travel.seen().now;
  part_ = kBeginning;
  robot_.table.active(ticket);
}

void MasterSync::end(ErrorCode code) noexcept {
  if (on()) {
    robot_.table.end(ticket_, code);
    ticket_ = CommandTable::kNone;
  }
}

// Whatever moves the tool fails because of the master.
void MasterSync::fail(ErrorCode code, const char* why) noexcept {
  end(code);
  if (!robot_.states.moving()) {
    return;
  }
  if (robot_.job.running()) {
    robot_.job.fail({code}, why, JobRunner::kReported);
    group_.finish_service(code);
  } else {
    robot_.job.set_message(why);
  }
  group_.drop_motions(code);
  group_.stop_for(Fault{code});
}

double MasterSync::step(bool held) noexcept {
  if (!on()) {
    return 1;
  }
  const GroupStates& states = robot_.states;
  if (!(states.is(GroupState::Standby) || states.moving()) || (ends_ && !states.moving())) {
    end(ErrorCode::Aborted);
    return 1;
  }
  const Master now = master();
  if (now.code != ErrorCode::Ok) {
    fail(now.code, "the master that the path follows is lost: check its drive or its encoder, then synchronize again");
    return 0;
  }
  if (conveyor_.on()) {
    fail(ErrorCode::State, "the path cannot follow a master while the tool moves with a belt");
    return 0;
  }
  const double moved = ratio_ * (now.place - seen_);
  const bool stands = held || robot_.follower.idle();
  seen_ = now.place;
  wanted_ += stands ? 0 : moved;
  const double gone = robot_.travel.seen().now;
  if (robot_.follower.idle()) {
    wanted_ = gone;  // a distance that remains at the end of a motion is not one of the next
    part_ = kBeginning;
  }
  const double lag = wanted_ - gone;
  if (!stands && std::abs(lag) > most_) {
    fail(lag > 0 ? ErrorCode::Speed : ErrorCode::Master,
         lag > 0 ? "the path cannot keep up with its master: let that be slower, or the motion faster"
                 : "the master of the path turns back farther than is permitted");
    return 0;
  }
  robot_.table.reached(ticket_, !stands && std::abs(lag) <= kInStep);
  part_ = robot_.follower.idle() ? part_ : part_for(lag, ratio_ * now.speed);
  return part_;
}

// The part of full speed at which the tool has the master's speed, and makes up for a distance that is missing. Before
// a path that begins can become fast, the part has to be smaller, so it looks ahead as far as a change takes.
double MasterSync::part_for(double lag, double speed) const noexcept {
  const double wanted = speed + (lag > 0 ? kPull : kPush) * lag;
  if (wanted <= 0) {
    return 0;
  }
  const double least = kLeastShare * robot_.parts.tool.velocity;
  const Follower& follower = robot_.follower;
  const Arm& arm = robot_.tool.arm();
  const double full = std::max({speed_ahead(follower, 0, arm), speed_ahead(follower, kSyncAhead, arm), least});
  const double part = std::min(wanted / full, 1.0);
  return part_ > 0 ? std::sqrt(part * std::max(part_, 0.01)) : part;
}

}  // namespace indurop::robot
