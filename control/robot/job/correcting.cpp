// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/correcting.h"

#include <indurop/robot/controller.h>

#include <array>

namespace indurop::robot {

void Correcting::skip(const Step& step) noexcept {
  if (step.op == Op::Correct) {
    skipped_ = step.slot >= 0;
  }
}

StepValues::Flaw Correcting::run(const Step& step, const JobPlaces& places, MotionPort& port, bool& done) noexcept {
  if (step.slot < 0) {
    done = end(port);
    skipped_ = false;
    return {};
  }
  if (on()) {
    return {"CORRECT is on already; end it with CORRECT OFF before"};
  }
  const JobCorrection& correction = book_.corrections[static_cast<std::size_t>(step.slot)];
  const Quat axes = step.index >= 0 ? places.frame(step.index).orientation : Quat::Identity();
  done = port.begin_correction({axes, correction.by_tool, correction.limit, correction.rate});
  if (done) {
    now_ = step.slot;
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
    return {"a job cannot begin between CORRECT and CORRECT OFF; begin at the line of the CORRECT"};
  }
  if (!on()) {
    return {};
  }
  if (is_of_joints(motion.move)) {
    return {"CORRECT shifts lines, circles and splines; end it with CORRECT OFF before another motion"};
  }
  if (motion.index < 0) {
    return {"HERE, FOUND and BACK include the correction; end it with CORRECT OFF before you move there"};
  }
  return {};
}

// While the robot is at standstill nothing is shifted, and a measurement need not come.
StepValues::Flaw Correcting::step(double seconds, const StepValues& values, Signals& signals,
                                  MotionPort& port) noexcept {
  if (!on()) {
    return {};
  }
  const JobCorrection& correction = book_.corrections[static_cast<std::size_t>(now_)];
  if (correction.beat >= 0) {
    const double beat = signals.read(static_cast<std::size_t>(correction.beat));
    age_ = beat != beat_ || !port.is_moving() ? 0 : age_ + seconds;
    beat_ = beat;
    if (age_ > correction.age) {
      return {"the correction has had no new measurement for the time that its AGE allows; check the sensor"};
    }
  }
  std::array<double, 3> shift{};
  const StepValues::Flaw flaw = values.numbers(correction.formula, shift.size(), signals, port, shift.data());
  if (flaw.ok()) {
    port.correct(Vec3(shift[0], shift[1], shift[2]) / 1000);
  }
  return flaw;
}

}  // namespace indurop::robot
