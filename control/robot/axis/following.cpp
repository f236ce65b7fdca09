// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/following.h"

#include "control/robot/axis/control.h"

namespace indurop::robot {

void AxisFollowing::engage(const AxisFollow& way, const LineLimits& limits, const LineLimits& most,
                           const LineState& now) noexcept {
  leaders_ = way.leaders;
  leading_ = way.leading;
  coupling_.engage(way.law, limits, most, now);
  coupled_ = true;
  leaving_ = false;
}

void AxisFollowing::superimpose(double distance, const LineLimits& limits, const LineLimits& most,
                                const LineState& now) noexcept {
  if (!coupled_ && !over_) {
    coupling_.engage({}, limits, most, now);
    over_ = true;
  }
  coupling_.shift(distance, limits);
}

void AxisFollowing::release(AxisMotion& motion) noexcept {
  if (over_) {
    motion.lend(coupling_.state());
  }
  leaving_ = leaving_ || coupled_ || over_;
  coupled_ = over_ = false;
}

ErrorCode AxisFollowing::step(const AxisNeighbours& row, double seconds) noexcept {
  AxisCoupling::Master master;
  bool all_lead = true;
  if (leading_ == 0) {
    master = {row.travel->before, row.travel->now};
    all_lead = row.travel->leads;
  }
  for (const AxisLeader& leader : leaders()) {
    const LineState& before = row.gate(leader.axis).state();
    const AxisControl& axis = row.axis(leader.axis);
    master.before.position += leader.ratio * before.position;
    master.before.velocity += leader.ratio * before.velocity;
    master.before.acceleration += leader.ratio * before.acceleration;
    master.now += leader.ratio * axis.commanded().position;
    all_lead = all_lead && axis.leads();
  }
  return all_lead ? coupling_.step(master, row.own_gate(), seconds) : ErrorCode::Master;
}

ErrorCode AxisFollowing::step_over(const LineState& own, const SetPointGate& gate, double seconds) noexcept {
  return coupling_.step({gate.state(), own.position}, gate, seconds);
}

}  // namespace indurop::robot
