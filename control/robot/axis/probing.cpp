// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/probing.h"

namespace indurop::robot {

void Probing::begin(int ticket, const Command& command) noexcept {
  constexpr int kFalling = 1;
  constexpr int kAtMark = 2;
  const bool windowed = command.job == 1;
  if (command.option < 0 || command.option > (kFalling | kAtMark) || (windowed && !(command.to[0] <= command.to[1]))) {
    answers_.answer(ticket, AxisService::TouchProbe, ErrorCode::Value);
    return;
  }
  answers_.finish(owner_, ErrorCode::Aborted);
  owner_ = {ticket, AxisService::TouchProbe};
  answers_.active(ticket);
  windowed_ = windowed;
  first_ = command.to[0];
  last_ = command.to[1];
  probe_.begin((command.option & kFalling) == 0, (command.option & kAtMark) != 0);
}

void Probing::abort(int ticket) noexcept {
  const bool was = owner_.any();
  answers_.finish(owner_, ErrorCode::Aborted);
  probe_.stop();
  answers_.answer(ticket, AxisService::AbortTrigger, was ? ErrorCode::Ok : ErrorCode::State);
}

void Probing::sense(const DriveIn& in, const AxisUnits& units) noexcept {
  if (!probe_.sense(in)) {
    return;
  }
  const double place = units.for_users(units.position(probe_.counts()));
  if (windowed_ && !(place >= first_ && place <= last_)) {
    probe_.again();
    return;
  }
  answers_.report().probe = place;
  answers_.finish(owner_, ErrorCode::Ok);
}

}  // namespace indurop::robot
