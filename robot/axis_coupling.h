// SPDX-License-Identifier: Apache-2.0
// Set points of an axis that follows another one, one for each of its master's. It gets there within its limits from
// whatever it was doing, and is then exactly where the law says. Leaving, it takes back its acceleration first, so that
// an ordinary motion can go on from there.

#pragma once

#include "robot/approach.h"
#include "robot/cam.h"
#include "robot/errors.h"
#include "robot/profile.h"
#include "robot/set_point_gate.h"

namespace indurop::robot {

// Where the follower is for each place of its master. In gear only the speed is that of the law.
struct CouplingLaw {
  double ratio = 1;
  Cam cam;                                 // known(): instead of the ratio
  Approach approach;                       // known(): how it comes to the ratio
  double master_zero = 0, slave_zero = 0;  // where the cam's zeros are, or both in gear
  double master_scale = 1, slave_scale = 1;
  // The law says places, not only the speed.
  [[nodiscard]] bool places() const noexcept { return cam.known() || approach.known(); }
  [[nodiscard]] double at(double master) const noexcept {
    if (approach.leads(master)) {
      return approach.at(master);
    }
    return slave_zero +
           (cam.known() ? slave_scale * cam.at((master - master_zero) / master_scale) : ratio * (master - master_zero));
  }
};

class AxisCoupling {
 public:
  // From the next step on; until then the axis is at `now`. `limits` of the way to the law, and no higher than `most`,
  // which are those of the axis. Real-time safe, as all here.
  void engage(const CouplingLaw& law, const LineLimits& limits, const LineLimits& most, const LineState& now) noexcept;

  // What is between the law and the axis becomes so much more than it is. It is synced() again when that is done.
  void shift(double by, const LineLimits& limits) noexcept;
  // No further.
  void stop_shift(const LineLimits& limits) noexcept;
  // The law sees its master so much further on than it is. `limits` are those of that way, in what the master counts;
  // what the follower has no room for comes later. It is synced() again when that is done.
  void shift_master(double to, const LineLimits& limits) noexcept;
  [[nodiscard]] double phase() const noexcept { return phase_.position; }

  struct Master {
    LineState before;  // its set point of the last period, as its gate has it
    double now = 0;    // that of this one
  };
  // The next set point, as state(). `gate`: of the follower, before it. Errors: those of SetPointGate::check(), and
  // there is no set point; whoever gets one has to leave.
  ErrorCode step(const Master& master, const SetPointGate& gate, double seconds) noexcept;
  // Somebody holds all motions: what it has not caught up with waits. It follows all the same.
  void hold(bool held) noexcept;
  // Instead of step() from then on, until there is no acceleration left: true. Where that would lead too near to the
  // end of the axis the gate has to brake until it rests: brakes().
  bool leave(const SetPointGate& gate, double seconds) noexcept;
  [[nodiscard]] bool brakes() const noexcept { return brakes_; }

  [[nodiscard]] const LineState& state() const noexcept { return state_; }
  // It is where the law says, but for what it had not caught up with before.
  [[nodiscard]] bool synced() const noexcept { return synced_ && !law_.approach.known(); }

 private:
  void begin(const LineState& master, double seconds) noexcept;
  void plan(const LineState& from, double seconds) noexcept;
  void put(double position, const LineState& before, double seconds) noexcept;
  void step_phase(double seconds) noexcept;
  [[nodiscard]] ErrorCode judge_approach(double master, double jerk, double seconds) noexcept;

  CouplingLaw law_;
  LineLimits limits_, most_;
  bool begun_ = false;
  bool planned_ = false;
  bool synced_ = false;
  bool brakes_ = false;
  bool held_ = false;
  bool to_place_ = false;  // the gap is to be closed, else it may stay as it is
  double goal_ = 0;        // what is to be left of it
  LineState law_state_;    // where the law is, as differences between periods
  Profile gap_;            // what is between the law and the axis, until it is caught up with
  double time_ = 0;
  LineState phase_;  // what the master is further on
  double phase_to_ = 0;
  LineLimits phase_limits_;
  Profile phase_way_;
  double phase_time_ = 0;
  bool phasing_ = false;
  bool phase_planned_ = false;
  LineState state_;
};

}  // namespace indurop::robot
