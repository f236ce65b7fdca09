// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/command_press.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

// What PRESS of jobs permits.
constexpr double kPressForce = 1e5;      // N
constexpr double kPressStiffness = 1e5;  // N/mm
constexpr double kPressShift = 1000;     // mm, and mm/s
constexpr double kPressAge = 86400;      // s
constexpr double kPressPatience = 0.1;   // s without an update of the command, as for belts
constexpr double kPressUnit = 0.001;     // m in a mm
// A force is reached within a tenth of it, or within 1 N.
constexpr double kPressNear = 0.1;
constexpr double kPressNearForce = 1;

// Where the numbers of a command are: forces and measurements along x, y and z, then the count of the measurements; and
// stiffnesses along x, y and z, then the limits.
constexpr std::size_t kAtMeasured = 3;
constexpr std::size_t kAtCount = 6;
constexpr std::size_t kAtMost = 3;
constexpr std::size_t kAtLimit = 4;
constexpr std::size_t kAtAge = 5;

bool is_press_limit(double value, double most) noexcept {
  return value > 0 && value <= most;
}

}  // namespace

ErrorCode CommandPress::check(const Command& command) const noexcept {
  const double* const begin = command.aux.data();
  const bool stiff = std::all_of(begin, begin + kAtMost, [](double k) { return k >= 0 && k <= kPressStiffness; }) &&
                     std::any_of(begin, begin + kAtMost, [](double k) { return k > 0; });
  const bool axes =
      command.option == 1 ||
      (command.option == 0 && (command.coords == CoordSystem::Machine || command.coords == CoordSystem::Product));
  if (!stiff || !axes || !is_press_limit(command.aux[kAtMost], kPressForce) ||
      !is_press_limit(command.aux[kAtLimit], kPressShift) || !is_press_limit(command.velocity, kPressShift) ||
      !(command.aux[kAtAge] >= 0 && command.aux[kAtAge] <= kPressAge) || command.buffer != BufferMode::Aborting) {
    return ErrorCode::Value;
  }
  if (const ErrorCode code = group_.may_move(); code != ErrorCode::Ok) {
    return code;
  }
  const bool ready = robot_.states.is(GroupState::Standby) && !group_.is_serving() && !conveyor_.product_moves();
  return ready && !on() ? ErrorCode::Ok : ErrorCode::State;
}

void CommandPress::take(int ticket) noexcept {
  const Command& command = robot_.table.command(ticket);
  if (const ErrorCode code = check(command); code != ErrorCode::Ok) {
    robot_.table.end(ticket, code);
    return;
  }
  ticket_ = ticket;
  begun_ = halted_ = false;
  const bool by_product = command.option == 0 && command.coords == CoordSystem::Product;
  way_ = {by_product ? conveyor_.product().orientation : Quat::Identity(),
          command.option == 1,
          command.aux[kAtLimit] * kPressUnit,
          command.velocity * kPressUnit,
          {}};
  for (std::size_t i = 0; i < way_.pressed.size(); ++i) {
    way_.pressed[i] = command.aux[i] > 0;
    stiffness_[i] = command.aux[i] / kPressUnit;
  }
  most_ = command.aux[kAtMost];
  patience_ = command.aux[kAtAge];
  count_ = command.to[kAtCount];
  silent_ = age_ = 0;
  group_.drop_aside();  // an interrupted job is not continued after other motions
  robot_.stand_here();
  robot_.states.move();
  begin();
  sense();
}

// It may have to wait: an abandoned plan may still be in use.
void CommandPress::begin() noexcept {
  begun_ = motions_.begin_correction(way_);
  if (begun_) {
    robot_.table.active(ticket_);
  }
}

void CommandPress::sense() noexcept {
  if (on()) {
    robot_.states.set_press(goes_on() ? GroupStates::Press::On : GroupStates::Press::Changing);
  }
}

// The program has to be alive, and if it counts its measurements, the sensor, too.
bool CommandPress::is_silent(const Command& command) noexcept {
  silent_ = robot_.table.updated(ticket_) ? 0 : silent_ + robot_.period;
  age_ = command.to[kAtCount] != count_ ? 0 : age_ + robot_.period;
  count_ = command.to[kAtCount];
  return silent_ > kPressPatience || (patience_ > 0 && age_ > patience_);
}

void CommandPress::press(const Command& command) noexcept {
  PressNeeds needs;
  double squares = 0;
  bool reached = true;
  bool known = true;
  for (std::size_t i = 0; i < needs.size(); ++i) {
    if (way_.pressed[i]) {
      const double wanted = command.to[i];
      const double measured = command.to[kAtMeasured + i];
      needs[i] = press_need(wanted, measured, stiffness_[i]);
      squares += measured * measured;
      known = known && std::isfinite(wanted);
      reached = reached && std::abs(measured - wanted) <= std::max(kPressNear * std::abs(wanted), kPressNearForce);
    }
  }
  if (!known) {
    fail("the force with which the tool is to press is no number");
  } else if (!(std::sqrt(squares) <= most_)) {
    fail("the measured force is more than the MaxForce of RobotPress: what is in the way, or is Stiffness too low?");
  } else {
    robot_.table.reached(ticket_, reached);
    motions_.press(needs);
  }
}

void CommandPress::step() noexcept {
  if (!on()) {
    return;
  }
  if (!robot_.states.moving()) {
    end(robot_.states.to_error() ? robot_.states.error() : ErrorCode::Aborted);
    return;
  }
  const Command& command = robot_.table.command(ticket_);
  if (!begun_) {
    begin();
  } else if (!goes_on()) {
    robot_.table.reached(ticket_, false);
    if ((halted_ || queue_.empty()) && motions_.end_correction()) {
      end(halted_ ? ErrorCode::Aborted : ErrorCode::Ok);
    }
  } else if (is_silent(command)) {
    fail("RobotPress has had no new measurement in time: check the sensor, and that the program calls the block");
  } else {
    press(command);
  }
}

void CommandPress::end(ErrorCode code) noexcept {
  robot_.table.end(ticket_, code);
  ticket_ = CommandTable::kNone;
  robot_.states.end_press(code != ErrorCode::Ok);
}

void CommandPress::fail(const char* why) noexcept {
  end(ErrorCode::Force);
  robot_.job.set_message(why);
  group_.drop_motions(ErrorCode::Force);
  group_.stop_for(Fault{ErrorCode::Force});
}

}  // namespace indurop::robot
