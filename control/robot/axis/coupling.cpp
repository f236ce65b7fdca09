// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/coupling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

namespace {

// Minimum part of the axis' limits for catching up, whatever its master does. The gate limits the sum anyway.
constexpr double kLeastPart = 0.2;
constexpr double kMargin = 1 + 1e-4;

LineState difference(double now, const LineState& before, double seconds) noexcept {
  const double velocity = (now - before.position) / seconds;
  return {now, velocity, (velocity - before.velocity) / seconds};
}

constexpr double kRounding = 2 * std::numeric_limits<double>::epsilon();  // of what a position is computed from

double left(double limit, double used, double most) noexcept {
  return std::max(limit - std::abs(used), std::min(limit, kLeastPart * most));
}

}  // namespace

// A motion computes its places from those where it began, so that they are rounded as those of a turn at least. Places
// of a tool on its path are rounded further.
double CouplingLaw::rounding_at(double master, double phase) const noexcept {
  constexpr double kTurn = 2 * kPi;
  const double from = kTurn + std::abs(master) + std::abs(phase) + std::abs(master_zero);
  const double there = master + phase;
  if (approach.leads(there)) {
    return kRounding * (std::abs(approach.slope_at(there)) * from + approach.size());
  }
  const double own = std::abs(slave_zero) + std::abs(at(there));
  if (cam.known()) {
    const double slope = slave_scale / master_scale * cam.slope_at((there - master_zero) / master_scale);
    return kRounding * (std::abs(slope) * from + own + std::abs(slave_scale) * cam.size());
  }
  return kRounding * (std::abs(ratio) * from + own) + std::abs(ratio) * master_rounding;
}

void AxisCoupling::engage(const CouplingLaw& law, const LineLimits& limits, const LineLimits& most,
                          const LineState& now) noexcept {
  law_ = law;
  limits_ = limits;
  most_ = most;
  begun_ = planned_ = synced_ = brakes_ = phasing_ = false;
  state_ = now;
  phase_ = {};
  to_place_ = law.places();
  goal_ = 0;
}

// Initializes the state of the law from the last periods of its master.
void AxisCoupling::begin(const LineState& master, double seconds) noexcept {
  const double one = master.position - seconds * master.velocity;
  const double two = one - seconds * (master.velocity - seconds * master.acceleration);
  const LineState oldest{law_.at(two), (law_.at(one) - law_.at(two)) / seconds, 0};
  law_state_ = {law_.at(one), oldest.velocity, 0};
  law_state_ = difference(law_.at(master.position), law_state_, seconds);
  begun_ = true;
}

// `from`: the gap as differences between periods, which equal the values in the middle of a period.
void AxisCoupling::plan(const LineState& from, double seconds) noexcept {
  const LineLimits limits{left(limits_.velocity, law_state_.velocity, most_.velocity),
                          left(limits_.acceleration, law_state_.acceleration, most_.acceleration), limits_.jerk};
  const LineState gap{from.position, from.velocity + from.acceleration * seconds / 2, from.acceleration};
  gap_ = to_place_ && !held_ ? Profile::to_rest(gap, goal_, limits) : Profile::to_velocity(gap, 0, limits);
  time_ = 0;
  planned_ = true;
}

void AxisCoupling::put(double position, const LineState& before, double seconds) noexcept {
  state_ = difference(position, before, seconds);
}

ErrorCode AxisCoupling::step(const Master& master, const SetPointGate& gate, double seconds) noexcept {
  if (!begun_) {
    begin(master.before, seconds);
  }
  const LineState& set_point = gate.state();
  const LineState last = law_state_;
  step_phase(seconds);
  law_state_ = difference(law_.at(master.now + phase_.position), last, seconds);
  const double jerk = (law_state_.acceleration - last.acceleration) / seconds;
  if (const ErrorCode code = judge_approach(master.now, jerk, seconds); code != ErrorCode::Ok) {
    return code;
  }
  if (!planned_) {
    plan({set_point.position - last.position, set_point.velocity - last.velocity,
          set_point.acceleration - last.acceleration},
         seconds);
  }
  time_ += seconds;
  const bool ended = time_ >= gap_.duration();
  const double wanted = law_state_.position + (ended ? gap_.end() : gap_.at(time_)).position;
  const double next = synced_ ? wanted : gate.nearest(wanted);
  if (const ErrorCode code = gate.check(next, 1); code != ErrorCode::Ok) {
    return code;
  }
  // The gate allows for the rounding of paths, which in short periods is as large as the jerk limit.
  const double rounding = law_.rounding_at(master.now, phase_.position) + kRounding * std::abs(next);
  const double noise = 8 * rounding / (seconds * seconds);
  const double change = difference(next, set_point, seconds).acceleration - set_point.acceleration;
  if (std::abs(change) > most_.jerk * seconds * kMargin + noise) {
    return ErrorCode::Jerk;
  }
  // A change of acceleration just before its end still shows in the differences of three periods.
  const bool settled = gap_.duration() <= 0 || time_ >= gap_.duration() + 2 * seconds;
  synced_ = synced_ || (settled && next == wanted && !phasing_ && !(held_ && to_place_));
  planned_ = next == wanted;
  put(next, set_point, seconds);
  return ErrorCode::Ok;
}

void AxisCoupling::shift(double by, const LineLimits& limits) noexcept {
  goal_ = (begun_ ? state_.position - law_state_.position : 0) + by;
  to_place_ = true;
  limits_ = limits;
  planned_ = synced_ = false;
}

void AxisCoupling::stop_shift(const LineLimits& limits) noexcept {
  to_place_ = false;
  limits_ = limits;
  planned_ = synced_ = false;
}

void AxisCoupling::shift_master(double to, const LineLimits& limits) noexcept {
  goal_ = to_place_ || !begun_ ? goal_ : state_.position - law_state_.position;
  to_place_ = true;
  phase_to_ = to;
  phase_limits_ = limits;
  const double slope = law_.cam.known() ? 0 : std::abs(law_.ratio);
  if (slope > 0) {
    phase_limits_ = {
        std::min(limits.velocity, left(most_.velocity, law_state_.velocity, most_.velocity) / slope),
        std::min(limits.acceleration, left(most_.acceleration, law_state_.acceleration, most_.acceleration) / slope),
        std::min(limits.jerk, most_.jerk / slope)};
  }
  phasing_ = true;
  phase_planned_ = planned_ = synced_ = false;
}

void AxisCoupling::step_phase(double seconds) noexcept {
  if (!phasing_) {
    return;
  }
  if (!phase_planned_) {
    phase_way_ =
        held_ ? Profile::to_velocity(phase_, 0, phase_limits_) : Profile::to_rest(phase_, phase_to_, phase_limits_);
    phase_planned_ = true;
    phase_time_ = 0;
  }
  phase_time_ += seconds;
  const bool ended = phase_time_ >= phase_way_.duration();
  phase_ = ended ? LineState{held_ ? phase_way_.end().position : phase_to_, 0, 0} : phase_way_.at(phase_time_);
  phasing_ = !ended || held_;
}

// On its way into gear the law keeps the requested limits, and at its end the follower has to be synchronized.
ErrorCode AxisCoupling::judge_approach(double master, double jerk, double seconds) noexcept {
  if (!law_.approach.known()) {
    return ErrorCode::Ok;
  }
  if (!law_.approach.leads(master)) {
    law_.approach = {};
    return synced_ ? ErrorCode::Ok : ErrorCode::Speed;
  }
  const double noise = 8 * law_.rounding_at(master, phase_.position) / (seconds * seconds * seconds);  // of the jerk
  if (std::abs(law_state_.velocity) > limits_.velocity * kMargin) {
    return ErrorCode::Speed;
  }
  if (std::abs(law_state_.acceleration) > limits_.acceleration * kMargin + noise * seconds) {
    return ErrorCode::Acceleration;
  }
  return std::abs(jerk) > limits_.jerk * kMargin + noise ? ErrorCode::Jerk : ErrorCode::Ok;
}

void AxisCoupling::hold(bool held) noexcept {
  phase_planned_ = phase_planned_ && held == held_;
  planned_ = planned_ && (held == held_ || synced_);
  held_ = held;
}

bool AxisCoupling::leave(const SetPointGate& gate, double seconds) noexcept {
  const LineState& set_point = gate.state();
  const LineState next = gate.unloaded();
  const LineState later{next.position + 2 * seconds * next.velocity, next.velocity, next.acceleration};
  brakes_ = brakes_ || gate.check(next.position, 1) != ErrorCode::Ok || !gate.can_rest(later);
  if (brakes_ ? gate.at_rest() : gate.coasts()) {
    state_ = {set_point.position, set_point.velocity, 0};
    brakes_ = false;
    return true;
  }
  state_ = brakes_ ? gate.braked() : next;
  return false;
}

}  // namespace indurop::robot
