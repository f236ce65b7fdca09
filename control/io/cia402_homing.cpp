// SPDX-License-Identifier: Apache-2.0
#include "control/io/cia402_homing.h"

#include "control/io/encoder_mark.h"

namespace indurop::io {
namespace {

constexpr int kFirstWithoutMark = 17;  // methods 17 to 30 are methods 1 to 14 without the mark: they end at the edge
constexpr int kMarkBelow = 33;
constexpr int kMarkAbove = 34;

}  // namespace

AxisSwitches switches_at(const config::IoAxis& axis, double degrees) noexcept {
  const bool has_home = axis.home_from || axis.home_to;
  return {axis.low_limit && degrees <= *axis.low_limit, axis.high_limit && degrees >= *axis.high_limit,
          has_home && degrees >= axis.home_from.value_or(degrees) && degrees <= axis.home_to.value_or(degrees)};
}

Homing::Method Homing::method_of(int number) noexcept {
  const bool mark = number < kFirstWithoutMark;
  switch (mark ? number : number - kFirstWithoutMark + 1) {
    case 1:
      return {Switch::Low, -1, 1, false, mark};
    case 2:
      return {Switch::High, 1, -1, false, mark};
    case 3:
      return {Switch::Home, 1, -1, false, mark};
    case 4:
      return {Switch::Home, 1, 1, true, mark};
    case 5:
      return {Switch::Home, -1, 1, false, mark};
    case 6:
      return {Switch::Home, -1, -1, true, mark};
    case 7:
      return {Switch::Home, 1, -1, false, mark};
    case 8:
      return {Switch::Home, 1, 1, true, mark};
    case 9:
      return {Switch::Home, 1, -1, true, mark};
    case 10:
      return {Switch::Home, 1, 1, false, mark};
    case 11:
      return {Switch::Home, -1, 1, false, mark};
    case 12:
      return {Switch::Home, -1, -1, true, mark};
    case 13:
      return {Switch::Home, -1, 1, true, mark};
    case 14:
      return {Switch::Home, -1, -1, false, mark};
    case kMarkBelow - kFirstWithoutMark + 1:
      return {Switch::None, 0, -1, false, true};
    case kMarkAbove - kFirstWithoutMark + 1:
      return {Switch::None, 0, 1, false, true};
    default:
      return {};  // 35 and 37: the actual position
  }
}

void Homing::start() noexcept {
  method_ = method_of(axis_.homing.value_or(0));
  state_ = State::Moving;
  phase_ = method_.edge != Switch::None ? Phase::Search : Phase::Mark;
  direction_ = method_.edge != Switch::None ? method_.search : method_.cross;
  turned_ = 0;
}

bool Homing::is_on(const AxisSwitches& switches) const noexcept {
  return method_.edge == Switch::Low ? switches.low : method_.edge == Switch::High ? switches.high : switches.home;
}

void Homing::found(double at) noexcept {
  home_ = at;
  state_ = State::Done;
}

// A limit switch on the way to the home switch reverses the motion, once.
void Homing::search(const AxisSwitches& now) noexcept {
  if (is_on(now)) {
    phase_ = method_.goes_on ? Phase::Back : Phase::Cross;
    direction_ = method_.goes_on ? -method_.cross : method_.cross;
    return;
  }
  const bool at_end = direction_ > 0 ? now.high : now.low;
  if (at_end) {
    direction_ = -direction_;
    state_ = ++turned_ > 1 ? State::Failed : state_;
  }
}

double Homing::step(double before, double now) noexcept {
  if (state_ != State::Moving) {
    return 0;
  }
  const AxisSwitches switches = switches_at(axis_, now);
  switch (phase_) {
    case Phase::Search:
      search(switches);
      break;
    case Phase::Back:
      if (!is_on(switches)) {
        phase_ = Phase::Cross;
        direction_ = method_.cross;
      }
      break;
    case Phase::Cross:
      // While the axis still reverses, it may be on either side.
      if (is_on(switches) == method_.goes_on && (now - before) * method_.cross > 0) {
        if (!method_.mark) {
          found(now);
          return 0;
        }
        phase_ = Phase::Mark;
      }
      break;
    case Phase::Mark:
      if (method_.cross == 0) {
        found(now);
        return 0;
      }
      if (const auto at = mark_passed(axis_.mark, before, now); at && (now - before) * method_.cross > 0) {
        found(*at);
        return 0;
      }
      break;
  }
  if (state_ == State::Failed) {
    return 0;
  }
  return direction_ * (phase_ == Phase::Cross || phase_ == Phase::Mark ? axis_.creep_speed : axis_.home_speed);
}

}  // namespace indurop::io
