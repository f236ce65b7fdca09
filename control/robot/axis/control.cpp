// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/control.h"

#include <array>
#include <cmath>
#include <initializer_list>

#include "control/robot/axis/service.h"

namespace indurop::robot {

void AxisControl::set_up(const Axis& axis, const LineLimits& limits, const Scale& scale, bool absolute,
                         CommandTable* table, const Row& row) noexcept {
  AxisBody::set_up(scale, AxisBounds(axis, limits), absolute, row);
  answers_.set_table(table);
}

void AxisControl::sense(const DriveIn& in, double seconds) noexcept {
  probing_.sense(in, units());
  if (parts().pushing.sense(in, seconds)) {
    power_.want(false);
    fail(ErrorCode::Drive, 1);
  }
  measure(in, seconds);
  if (Drive::state_of(in.status) != Drive::State::OperationEnabled) {
    sense_without_power(in);
  } else if (state() == AxisState::Disabled) {
    parts().state = AxisState::Standstill;
  }
}

void AxisControl::sense_without_power(const DriveIn& in) noexcept {
  const bool moved = busy();
  put({measured(), 0, 0});  // the commanded position of a drive without power is where it is
  set_displaced();
  if (moved) {
    fail(ErrorCode::Drive, 1);
  } else if (state() == AxisState::Standstill && wants_power()) {
    const Drive::State drive = Drive::state_of(in.status);
    const bool fault = drive == Drive::State::Fault || drive == Drive::State::FaultReaction;
    fail(fault ? ErrorCode::Drive : ErrorCode::Power, 1);  // PLCopen: the axis leaves ErrorStop by a reset only
  } else if (state() != AxisState::ErrorStop) {
    parts().state = AxisState::Disabled;
    motions_.release_stop();
  }
}

void AxisControl::serve(const AxisRequest& request, ErrorCode permit) noexcept {
  AxisReport& report = answers_.report();
  if (first_) {
    // Requests from before this program started are not executed.
    first_ = false;
    report.acknowledged = report.aborted = request.number;
    return;
  }
  if (request.number == report.acknowledged) {
    return;
  }
  power_.end_request();
  motions_.end_request();
  report.acknowledged = request.number;
  const auto service = static_cast<AxisService>(request.code);
  if (permit != ErrorCode::Ok && service != AxisService::Reset && service != AxisService::PowerOn) {
    answers_.answer(AxisOwner::kRequest, service, permit);
    return;
  }
  answers_.forget_error();
  Command command;
  command.code = request.code;
  command.to[0] = request.position;
  command.velocity = request.velocity;
  command.acceleration = request.acceleration;
  command.jerk = request.jerk;
  order(AxisOwner::kRequest, command);
}

void AxisControl::take(int ticket, ErrorCode permit) noexcept {
  const Command& command = answers_.table().command(ticket);
  const AxisService service = axis_service_of(command);
  const bool always = service == AxisService::Reset || service == AxisService::PowerOn ||
                      service == AxisService::SetPosition || service == AxisService::TouchProbe ||
                      service == AxisService::AbortTrigger || service == AxisService::WriteParameter;
  if (permit != ErrorCode::Ok && !always) {
    answers_.table().end(ticket, permit);
    return;
  }
  answers_.forget_error();
  order(ticket, command);
}

void AxisControl::order(int ticket, const Command& command) noexcept {
  using Handler = void (*)(AxisControl&, int, const Command&) noexcept;
  static constexpr auto kServices = static_cast<std::size_t>(AxisService::FollowPath) + 1;
  // Handler of each service.
  static constexpr auto kBy = [] {
    using enum AxisService;
    std::array<Handler, kServices> by{};
    const auto set = [&by](Handler handler, std::initializer_list<AxisService> services) {
      for (const AxisService service : services) {
        by[static_cast<std::size_t>(service)] = handler;
      }
    };
    set([](AxisControl& a, int t, const Command&) noexcept { a.answers_.answer(t, None, ErrorCode::Ok); }, {None});
    set([](AxisControl& a, int t, const Command& c) noexcept { a.administer(t, c); }, {PowerOn, PowerOff, Reset});
    set([](AxisControl& a, int t, const Command& c) noexcept { a.motions_.take(t, c); },
        {Home, Halt, MoveAbsolute, MoveRelative, MoveAdditive, MoveVelocity, MoveContinuousAbsolute,
         MoveContinuousRelative, GearIn, CamIn, GearInPos, Combine, PositionProfile, VelocityProfile,
         AccelerationProfile, AxisService::TorqueControl, FollowPath});
    set([](AxisControl& a, int t, const Command& c) noexcept { a.motions_.take_stop(t, c); }, {Stop});
    set([](AxisControl& a, int t, const Command& c) noexcept { a.set_position(t, c); }, {SetPosition});
    set([](AxisControl& a, int t, const Command& c) noexcept { a.write_parameter(t, c); }, {WriteParameter});
    set([](AxisControl& a, int t, const Command& c) noexcept { a.motions_.superimposed().shift_master(t, c); },
        {ShiftMaster});
    set([](AxisControl& a, int t, const Command&) noexcept { a.motions_.decouple(t); }, {Decouple});
    set([](AxisControl& a, int t, const Command& c) noexcept { a.motions_.superimpose(t, c); }, {MoveSuperimposed});
    set([](AxisControl& a, int t, const Command& c) noexcept { a.motions_.superimposed().halt(t, c); },
        {HaltSuperimposed});
    set([](AxisControl& a, int t, const Command& c) noexcept { a.probing_.begin(t, c); }, {TouchProbe});
    set([](AxisControl& a, int t, const Command&) noexcept { a.probing_.abort(t); }, {AbortTrigger});
    return by;
  }();
  const auto code = static_cast<std::size_t>(command.code);
  if (code < kBy.size() && kBy[code] != nullptr) {
    kBy[code](*this, ticket, command);
  } else {
    answers_.answer(ticket, AxisService::None, ErrorCode::Opcode);
  }
}

void AxisControl::administer(int ticket, const Command& command) noexcept {
  if (power_.take(ticket, command)) {
    stop_for_power();
  }
}

// Power is switched off at rest; until then the axis brakes.
void AxisControl::stop_for_power() noexcept {
  motions_.release_stop();
  motions_.halt();
}

// Gives the present position a new value; nothing moves, and a motion keeps its target.
void AxisControl::set_position(int ticket, const Command& command) noexcept {
  const double wanted = command.to[0] * unit();
  ErrorCode code = ErrorCode::Ok;
  if (!std::isfinite(wanted)) {
    code = ErrorCode::Value;
  } else if (state() == AxisState::Homing) {
    code = ErrorCode::State;
  } else {
    const double from = command.option == 1 ? units().origin() : commanded().position;
    parts().units.set_origin(from - wanted);
  }
  answers_.answer(ticket, AxisService::SetPosition, code);
}

void AxisControl::write_parameter(int ticket, const Command& command) noexcept {
  AxisBounds& bounds = parts().bounds;
  const bool rests = !busy() && !in_group() && !motions_.waits();
  const ErrorCode code = bounds.change(command.option, command.to[0], units(), {rests, commanded().position});
  bounds.apply_to(parts().motion);
  answers_.answer(ticket, AxisService::WriteParameter, code);
}

void AxisControl::move(double seconds) noexcept {
  motions_.update();
  if (power_.keep()) {
    stop_for_power();
  }
  power_.wait_for_power(seconds);
  if (state() == AxisState::Homing) {
    motions_.step_home(seconds);
    return;
  }
  motions_.step(seconds);
  power_.step(seconds);
  motions_.note_ends();
}

void AxisControl::follow(const LineState& state) noexcept {
  put(state);
  motions_.release_stop();
  parts().state = AxisState::SynchronizedMotion;
}

void AxisControl::fail(ErrorCode code, double hardness) noexcept {
  power_.fail(code);
  motions_.fail(code, hardness);
}

DriveOut AxisControl::command(const DriveIn& in, bool quick_stop) noexcept {
  Drive& drive = parts().drive;
  drive.step(in, power_.want_of_drive(quick_stop));
  DriveOut out;
  out.control = drive.control();
  out.mode = drive.mode();
  out.position = units().counts(commanded().position);
  out.probe = probing_.function();
  return out;
}

AxisReport AxisControl::report() const noexcept {
  AxisReport report = answers_.report();
  const LineState& state = commanded();
  report.state = parts().state;
  report.power = power_.on();
  report.homed = homed();
  report.position = units().for_users(measured());
  report.command = units().for_users(state.position);
  report.acceleration = state.acceleration / unit();
  report.measured_velocity = parts().measured.speed / unit();
  bounds().report(units(), report);
  report.velocity = state.velocity / unit();
  const AxisFollowing& following = parts().following;
  report.phase = leaders().empty() ? 0 : following.phase() / parts().row.axis(leaders()[0].axis).unit();
  return report;
}

}  // namespace indurop::robot
