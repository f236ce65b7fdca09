// SPDX-License-Identifier: Apache-2.0
// Set points of an axis that follows another one, one for each set point of its master. It gets to the coupling law
// within its limits from any motion and then follows it exactly. When it leaves, it first removes its acceleration, so
// that an ordinary motion can continue from there.

#pragma once

#include "control/robot/axis/approach.h"
#include "control/robot/axis/cam.h"
#include "control/robot/axis/set_point_gate.h"
#include "control/robot/kinematics/errors.h"
#include "control/robot/path/profile.h"

namespace indurop::robot {

// Position of the follower for each position of its master. If it does not define positions, only the speed
// follows the law.
struct CouplingLaw {
  double ratio = 1;
  Cam cam;                                 // if known(): instead of the ratio
  Approach approach;                       // if known(): how it reaches the ratio
  double master_zero = 0, slave_zero = 0;  // positions of the cam's zeros, or of both axes in gear
  double master_scale = 1, slave_scale = 1;
  double master_rounding = 0;  // of the place of a tool on its path, m
  // Returns whether the law defines positions, not only the speed.
  [[nodiscard]] bool places() const noexcept { return cam.known() || approach.known(); }
  [[nodiscard]] double at(double master) const noexcept {
    if (approach.leads(master)) {
      return approach.at(master);
    }
    return slave_zero +
           (cam.known() ? slave_scale * cam.at((master - master_zero) / master_scale) : ratio * (master - master_zero));
  }
  // Returns by how much rounding may move at(master + phase): it passes on that of the master.
  [[nodiscard]] double rounding_at(double master, double phase) const noexcept;
};

class AxisCoupling {
 public:
  // Engages from the next step on; until then the axis is at `now`. `limits` apply on the way to the law, but not above
  // `most`, the limits of the axis. All functions of this class are real-time safe.
  void engage(const CouplingLaw& law, const LineLimits& limits, const LineLimits& most, const LineState& now) noexcept;

  // Increases the offset between the law and the axis by `by`. It is synced() again when that is done.
  void shift(double by, const LineLimits& limits) noexcept;
  // Stops the shift where it is.
  void stop_shift(const LineLimits& limits) noexcept;
  // Offsets the master's position as seen by the law to `to`. `limits` apply to this shift, in units of the master;
  // what the follower's limits do not allow at once comes later. It is synced() again when that is done.
  void shift_master(double to, const LineLimits& limits) noexcept;
  [[nodiscard]] double phase() const noexcept { return phase_.position; }

  struct Master {
    LineState before;  // its set point of the last period, as reported by its gate
    double now = 0;    // its set point of this period
  };
  // Computes the next set point, as state(). `gate`: the follower's, before this set point. Errors: those of
  // SetPointGate::check(); then there is no set point, and the caller has to leave.
  ErrorCode step(const Master& master, const SetPointGate& gate, double seconds) noexcept;
  // While held, the remaining distance to the law is not closed; the axis follows its master all the same.
  void hold(bool held) noexcept;
  // Called instead of step() from then on, until it returns true: there is no acceleration left. Where that would lead
  // too near to the end of the axis, the gate has to brake to standstill: brakes(). state() is where it then will be.
  bool leave(const SetPointGate& gate, double seconds) noexcept;
  [[nodiscard]] bool brakes() const noexcept { return brakes_; }

  [[nodiscard]] const LineState& state() const noexcept { return state_; }
  // Returns whether it follows the law exactly, apart from a distance that remained from before.
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
  double goal_ = 0;        // remaining gap to reach
  LineState law_state_;    // state of the law, as differences between periods
  Profile gap_;            // distance between the law and the axis, until it is caught up
  double time_ = 0;
  LineState phase_;  // offset of the master
  double phase_to_ = 0;
  LineLimits phase_limits_;
  Profile phase_way_;
  double phase_time_ = 0;
  bool phasing_ = false;
  bool phase_planned_ = false;
  LineState state_;
};

}  // namespace indurop::robot
