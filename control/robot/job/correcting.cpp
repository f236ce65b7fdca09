// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/correcting.h"

#include <indurop/robot/controller.h>

#include <array>
#include <cmath>

namespace indurop::robot {

void Correcting::skip(const Step& step) noexcept {
  if (step.op == Op::Correct) {
    skipped_ = step.slot >= 0;
  }
}

const JobCorrection& Correcting::now() const noexcept {
  return book_.corrections[static_cast<std::size_t>(now_)];
}

// While one is on: the text that fits it.
const char* Correcting::either(const char* correct, const char* press) const noexcept {
  return now().presses() ? press : correct;
}

StepValues::Flaw Correcting::run(const Step& step, int source, const JobPlaces& places, MotionPort& port,
                                 bool& done) noexcept {
  if (step.slot < 0) {
    if (on() && now().presses() != (step.mid == 1)) {
      return {either("CORRECT is on; it ends with CORRECT OFF", "PRESS is on; it ends with PRESS OFF")};
    }
    done = end(port);
    skipped_ = false;
    return {};
  }
  if (on()) {
    return {either("CORRECT is on already; end it with CORRECT OFF before",
                   "PRESS is on already; end it with PRESS OFF before")};
  }
  const JobCorrection& correction = book_.corrections[static_cast<std::size_t>(step.slot)];
  const Quat axes = step.index >= 0 ? places.frame(step.index).orientation : Quat::Identity();
  CorrectionWay way{axes, correction.by_tool, correction.limit, correction.rate, {}};
  for (int i = 0; i < correction.directions; ++i) {
    way.pressed[correction.along[static_cast<std::size_t>(i)]] = true;
  }
  done = port.begin_correction(way);
  if (done) {
    now_ = step.slot;
    source_ = source;
    skipped_ = false;
    age_ = 0;
  }
  return {};
}

bool Correcting::end(MotionPort& port) noexcept {
  if (on() && !port.end_correction()) {
    return false;
  }
  now_ = -1;
  return true;
}

StepValues::Flaw Correcting::check(const Step& motion) const noexcept {
  if (skipped_) {
    return {"a job cannot begin between CORRECT or PRESS and its OFF; begin at the line of the CORRECT or PRESS"};
  }
  if (!on()) {
    return {};
  }
  if (is_of_joints(motion.move)) {
    return {either("CORRECT shifts lines, circles and splines; end it with CORRECT OFF before another motion",
                   "PRESS shifts lines, circles and splines; end it with PRESS OFF before another motion")};
  }
  if (motion.index < 0) {
    return {either("HERE, FOUND and BACK include the correction; end it with CORRECT OFF before you move there",
                   "HERE, FOUND and BACK include how far the tool has pressed; end it with PRESS OFF before")};
  }
  return {};
}

// While the robot is at standstill nothing is corrected, and a measurement need not come; but a tool presses there,
// too.
StepValues::Flaw Correcting::step(double seconds, const StepValues& values, Signals& signals,
                                  MotionPort& port) noexcept {
  if (!on()) {
    return {};
  }
  const JobCorrection& correction = now();
  if (correction.beat >= 0) {
    const double beat = signals.read(static_cast<std::size_t>(correction.beat));
    const bool needed = correction.presses() || port.is_moving();
    age_ = beat != beat_ || !needed ? 0 : age_ + seconds;
    beat_ = beat;
    if (age_ > correction.age) {
      return {either("the correction has had no new measurement for the time that its AGE allows; check the sensor",
                     "PRESS has had no new measurement for the time that its AGE allows; check the sensor")};
    }
  }
  if (correction.presses()) {
    return press(values, signals, port);
  }
  std::array<double, 3> shift{};
  const StepValues::Flaw flaw = values.numbers(correction.formula, shift.size(), signals, port, shift.data());
  if (flaw.ok()) {
    port.correct(Vec3(shift[0], shift[1], shift[2]) / 1000);
  }
  return flaw;
}

StepValues::Flaw Correcting::press(const StepValues& values, Signals& signals, MotionPort& port) const noexcept {
  const JobCorrection& correction = now();
  std::array<double, 6> force{};  // wanted and measured, N, of each direction
  const auto count = static_cast<std::size_t>(correction.directions);
  const StepValues::Flaw flaw = values.numbers(correction.formula, 2 * count, signals, port, force.data());
  if (!flaw.ok()) {
    return flaw;
  }
  PressNeeds needs;
  double squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double measured = force[2 * i + 1];
    needs[correction.along[i]] = press_need(force[2 * i], measured, correction.stiffness[i]);
    squares += measured * measured;
  }
  if (!(std::sqrt(squares) <= correction.most)) {
    return {"the measured force is more than the MOST of PRESS: what is in the way, or is STIFFNESS too low?"};
  }
  port.press(needs);
  return {};
}

}  // namespace indurop::robot
