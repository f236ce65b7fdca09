// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/single_axes.h"

#include "control/robot/group/robot.h"

namespace indurop::robot {

std::size_t SingleAxes::drive(int i) const noexcept {
  return at(robot_.count() + i);
}

void SingleAxes::halt() noexcept {
  robot_.singles.halt();
}

// Why all of them have to stop now; Ok: they do not.
ErrorCode SingleAxes::stop_of_all(bool emergency) const noexcept {
  if (emergency) {
    return ErrorCode::Emergency;
  }
  const bool crashed = robot_.states.failed() && robot_.states.error() == ErrorCode::Planner;
  return crashed ? ErrorCode::Planner : ErrorCode::Ok;
}

void SingleAxes::sense(const Inputs& in) noexcept {
  for (int i = 0; i < robot_.singles.count(); ++i) {
    AxisControl& a = robot_.singles[i];
    a.sense(in.drives[drive(i)], robot_.period);
    a.set_stops(in.emergency, false);
    quick_stop_[at(i)] = quick_stop_[at(i)] && a.state() == AxisState::ErrorStop;
  }
  if (const ErrorCode code = stop_of_all(in.emergency); code != ErrorCode::Ok) {
    fail_all(code);
  }
  robot_.singles.fail_behind();
}

void SingleAxes::fail_all(ErrorCode code) noexcept {
  const Settings& settings = robot_.parts.settings;
  const bool emergency = code == ErrorCode::Emergency;
  const bool cut = emergency && settings.emergency_category == StopCategory::Category0;
  for (int i = 0; i < robot_.singles.count(); ++i) {
    AxisControl& a = robot_.singles[i];
    if (quick_stop_[at(i)] || !(a.drive().enabled() || a.wants_power())) {
      continue;
    }
    quick_stop_[at(i)] = true;
    hardness_[at(i)] = emergency ? settings.emergency_factor : 1;
    a.power(a.wants_power() && !cut);
    a.fail(code, hardness_[at(i)]);
  }
}

void SingleAxes::serve(const Inputs& in, ErrorCode permit) noexcept {
  for (int i = 0; i < robot_.singles.count(); ++i) {
    robot_.singles[i].serve(in.axes[drive(i)], permit);
  }
}

// The way of a stop counts, too. Drives that home, or have no power, move the arm on their own.
void SingleAxes::measure_travel(bool path_follows) noexcept {
  const bool leads = robot_.states.powered() && !robot_.states.is(GroupState::Homing) && !robot_.axes.any_displaced();
  const bool followed = path_follows || robot_.singles.count() > 0;
  robot_.travel.step(robot_.tool.arm(), robot_.axes.passed(), leads, followed, robot_.period);
}

void SingleAxes::step(const Inputs& in, Outputs& out, bool path_follows) noexcept {
  measure_travel(path_follows);
  robot_.singles.move();
  for (int i = 0; i < robot_.singles.count(); ++i) {
    pass(i);
    const bool rests = robot_.singles.gate(i).at_rest();
    out.drives[drive(i)] = robot_.singles[i].command(in.drives[drive(i)], quick_stop_[at(i)] && rests);
    braking_[at(i)] = braking_[at(i)] && !rests;
    hardness_[at(i)] = rests ? 1 : hardness_[at(i)];
  }
}

void SingleAxes::pass(int i) noexcept {
  AxisControl& a = robot_.singles[i];
  SetPointGate& gate = robot_.singles.gate(i);
  const double position = a.commanded().position;
  const double hardness = hardness_[at(i)];
  if (a.displaced()) {
    gate.stand(position);
  } else if (a.brakes()) {
    gate.brake(1);
    a.braked(gate.state());
  } else if (!braking_[at(i)]) {
    const ErrorCode code = gate.check(position, hardness);
    if (code == ErrorCode::Ok) {
      gate.pass(position, hardness);
      return;
    }
    a.fail(code, hardness);
    braking_[at(i)] = true;
  }
  if (braking_[at(i)]) {
    gate.brake(hardness);
    a.put(gate.state());
  }
}

void SingleAxes::report(Outputs& out) const noexcept {
  for (int i = 0; i < robot_.singles.count(); ++i) {
    const AxisReport report = robot_.singles[i].report();
    out.axes[drive(i)] = report;
    out.joints[drive(i)] = report.position;
    out.command[drive(i)] = report.command;
    out.speed[drive(i)] = report.velocity;
    out.acceleration[drive(i)] = report.acceleration;
  }
}

}  // namespace indurop::robot
