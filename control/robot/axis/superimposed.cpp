// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/superimposed.h"

#include <algorithm>
#include <cmath>

#include "control/robot/axis/control.h"

namespace indurop::robot {

namespace {

constexpr double kMostShift = 1e6;  // deg or mm

}  // namespace

ErrorCode SuperimposedMotion::check(const Command& command, const Own& own) const noexcept {
  const AxisFollowing& following = parts_.following;
  const bool coupled = following.coupled();
  const bool moves = parts_.state == AxisState::Standstill || parts_.state == AxisState::DiscreteMotion ||
                     parts_.state == AxisState::ContinuousMotion || coupled;
  const bool catches_up = coupled && !owner_.any() && !following.synced();
  const bool shifts = owner_.service == AxisService::ShiftMaster;
  if (!parts_.drive.enabled() || !moves || parts_.pushing.on() || following.leaving() || catches_up || shifts ||
      own.waits) {
    return ErrorCode::State;
  }
  if (coupled || parts_.state == AxisState::ContinuousMotion) {
    return ErrorCode::Ok;
  }
  // Position after both motions have ended.
  const double left = own.to_position ? parts_.motion.target() - parts_.motion.state().position : 0;
  const double end = parts_.commanded().position + left + command.to[0] * parts_.units.unit();
  return parts_.bounds.inside(end, end) ? ErrorCode::Ok : ErrorCode::JointLimit;
}

void SuperimposedMotion::take(int ticket, AxisService service) noexcept {
  owner_ = {ticket, service};
  answers_.active(ticket);
}

void SuperimposedMotion::begin(int ticket, const Command& command, const Own& own) noexcept {
  AxisOrder order;
  ErrorCode code = resolver_.resolve(command, 0, order);
  code = code == ErrorCode::Ok ? check(command, own) : code;
  if (code != ErrorCode::Ok) {
    answers_.answer(ticket, AxisService::MoveSuperimposed, code);
    return;
  }
  end(ErrorCode::Aborted);
  LineLimits limits = order.limits;
  limits.acceleration = std::min(limits.acceleration, order.braking.acceleration);
  parts_.following.superimpose(command.to[0] * parts_.units.unit(), limits, parts_.bounds.most(),
                               parts_.motion.state());
  parts_.state = parts_.state == AxisState::Standstill ? AxisState::DiscreteMotion : parts_.state;
  take(ticket, AxisService::MoveSuperimposed);
}

void SuperimposedMotion::halt(int ticket, const Command& command) noexcept {
  AxisOrder order;
  const ErrorCode code = resolver_.resolve(command, 0, order);
  if (code != ErrorCode::Ok || !owner_.any() || owner_.service == AxisService::ShiftMaster) {
    answers_.answer(ticket, AxisService::HaltSuperimposed, code != ErrorCode::Ok ? code : ErrorCode::State);
    return;
  }
  end(ErrorCode::Aborted);
  parts_.following.stop_superimposed(order.braking);
  take(ticket, AxisService::HaltSuperimposed);
}

ErrorCode SuperimposedMotion::check_shift(const Command& command) const noexcept {
  const AxisFollowing& following = parts_.following;
  const bool on_top = owner_.any() && owner_.service != AxisService::ShiftMaster;
  if (!parts_.drive.enabled() || !following.coupled() || on_top || (!owner_.any() && !following.synced())) {
    return ErrorCode::State;
  }
  const std::span<const AxisLeader> leaders = following.leaders();
  const bool one_master = leaders.size() == 1 && command.option == parts_.row.first + leaders[0].axis + 1;
  const bool sane = std::abs(command.to[0]) <= kMostShift && command.buffer == BufferMode::Aborting;
  return one_master && sane ? ErrorCode::Ok : ErrorCode::Value;
}

// The master itself is not affected.
void SuperimposedMotion::shift_master(int ticket, const Command& command) noexcept {
  AxisOrder order;
  ErrorCode code = resolver_.resolve(command, 0, order);
  code = code == ErrorCode::Ok ? check_shift(command) : code;
  if (code != ErrorCode::Ok) {
    answers_.answer(ticket, AxisService::ShiftMaster, code);
    return;
  }
  end(ErrorCode::Aborted);
  const AxisControl& master = parts_.row.axis(parts_.following.leaders()[0].axis);
  const double unit = master.unit();
  const LineLimits& most = master.bounds().most();
  const auto chosen = [unit](double wanted, double least) {
    return wanted == 0 ? least : std::min(wanted * unit, least);
  };
  const double slowing = command.deceleration == 0 ? command.acceleration : command.deceleration;
  const LineLimits limits{chosen(command.velocity, most.velocity),
                          std::min(chosen(command.acceleration, most.acceleration), chosen(slowing, most.acceleration)),
                          chosen(command.jerk, most.jerk)};
  const double from = command.job == 1 ? parts_.following.phase() : 0;
  parts_.following.shift_master(from + command.to[0] * unit, limits);
  take(ticket, AxisService::ShiftMaster);
}

void SuperimposedMotion::end_request() noexcept {
  if (owner_.is_request()) {
    end(ErrorCode::Aborted);
  }
}

void SuperimposedMotion::note() noexcept {
  if (owner_.any() && parts_.following.synced()) {
    end(ErrorCode::Ok);
  }
}

}  // namespace indurop::robot
