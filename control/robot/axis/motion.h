// SPDX-License-Identifier: Apache-2.0
// Motion of a single axis: to a position, also through it with a velocity, continuously with a velocity, or to rest;
// each from any motion. A request in mid-move may allow less acceleration and jerk than the axis needs to keep its
// speed limit and its ends: then it brakes harder, within its own limits, until the requested ones are enough. An
// override slows it down at any moment, to rest at 0, and it continues when that ends.

#pragma once

#include <cmath>
#include <optional>

#include "control/robot/path/profile.h"
#include "control/robot/path/time_profile.h"

namespace indurop::robot {

class AxisMotion {
 public:
  // The axis' own limits and ends; none at first. All functions of this class are real-time safe.
  void set_bounds(const LineLimits& most, double lower, double upper) noexcept;
  // Continues in this state, with nothing to do.
  void reset(const LineState& state) noexcept;
  // Another component moves the axis: it is in this state, and the request waits until go_on().
  void lend(const LineState& state) noexcept;
  void go_on() noexcept;
  // Moves as fast as the limits allow, also where the distance is too short or backwards.
  void move_to(double position, const LineLimits& limits, const LineLimits& braking) noexcept;
  void move_to(double position, const LineLimits& limits) noexcept { move_to(position, limits, limits); }
  // On the way to a position: passes it with a velocity in the direction it has there, not above the axis' own. 0:
  // comes to rest there.
  void pass_with(double velocity) noexcept;
  // Passes a position with a velocity, whose sign gives the direction, and continues with it (through.cpp). It
  // takes a run-up first where necessary. Once it is on its final approach, an override may make it pass the position
  // with another velocity, but never turns it back.
  void move_through(double position, double velocity, const LineLimits& limits, const LineLimits& braking) noexcept;
  // Returns whether it has passed this position and continues.
  [[nodiscard]] bool went_through(double position) const noexcept;
  void go_on_with(double velocity, const LineLimits& limits, const LineLimits& braking) noexcept;
  // Returns where it has to come to rest before that: before its run-up, or where it turns. Nothing: it goes straight
  // there.
  [[nodiscard]] static std::optional<double> rests_first(const LineState& from, double position, double velocity,
                                                         const LineLimits& limits, const LineLimits& braking) noexcept;
  void move_with(double velocity, const LineLimits& limits) noexcept;
  // Follows a table that begins at the present state of the axis (along.cpp). Then it rests, or continues with its
  // velocity once it has no acceleration. Overrides do not apply meanwhile: the caller stops the motion instead.
  void move_along(const TimeProfile& table, const LineLimits& limits, bool to_rest) noexcept;
  [[nodiscard]] bool along() const noexcept { return goal_ == Goal::Table; }
  [[nodiscard]] bool full_speed() const noexcept { return override_ == 1; }
  void stop(const LineLimits& limits) noexcept;
  // Part of the speed of motions, from 0 to 1; stops are not slowed down.
  void set_override(double part) noexcept;

  void step(double seconds) noexcept;
  // Returns the state that step() would lead to.
  [[nodiscard]] LineState after(double seconds) const noexcept { return on_profile(time_ + seconds); }

  // Position or velocity of the target, and the maximum speed.
  [[nodiscard]] double target() const noexcept { return target_; }
  [[nodiscard]] double speed() const noexcept { return limits_.velocity; }
  [[nodiscard]] const LineState& state() const noexcept { return state_; }
  // Returns whether it has reached the position, the velocity, or rest; not while an override of 0 holds it.
  [[nodiscard]] bool done() const noexcept {
    return !lent_ && !held() && !harder_ && goal_ != Goal::Through && !along() && time_ >= profile_.duration();
  }
  [[nodiscard]] bool at_rest() const noexcept { return done() && state_.velocity == 0 && !passed_; }
  // Returns whether it is exactly at the position that it passes; `rest_of_step()` seconds of the last step are left.
  [[nodiscard]] bool passed() const noexcept { return passed_; }
  [[nodiscard]] double rest_of_step() const noexcept { return left_over_; }

 private:
  enum class Goal { Rest, Position, Velocity, Through, Table };

  [[nodiscard]] bool held() const noexcept;
  void plan() noexcept;
  void plan_wanted() noexcept;
  bool plan_pass(double sign, double arrival) noexcept;
  void plan_through() noexcept;
  void step_through() noexcept;
  void step_along() noexcept;
  void go_behind() noexcept;
  [[nodiscard]] LineLimits hardest() const noexcept;
  [[nodiscard]] bool keeps_bounds() const noexcept;
  [[nodiscard]] bool turns_in_time(double side) const noexcept;
  [[nodiscard]] LineState on_profile(double time) const noexcept;

  LineLimits most_{HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double lower_ = -HUGE_VAL, upper_ = HUGE_VAL;
  bool lent_ = false;
  bool harder_ = false;  // brakes until the requested limits are enough to keep these bounds
  Goal goal_ = Goal::Rest;
  double target_ = 0;  // position or velocity
  LineLimits limits_, braking_;
  double arrival_ = 0;       // speed when passing the position, in the direction of the way there
  double end_velocity_ = 0;  // of a motion through a position
  bool on_last_way_ = false;
  TimeProfile table_;
  bool rests_ = false;  // at the end of the table
  std::optional<double> went_through_;
  bool passing_ = false;
  bool passed_ = false;
  double left_over_ = 0;
  // While it passes a position, the profile is a distance from `base_` in the direction of `sign_`; `faster_` comes
  // after it.
  double base_ = 0, sign_ = 1;
  Profile faster_;
  double override_ = 1;
  Profile profile_;
  double time_ = 0;
  LineState state_;
};

}  // namespace indurop::robot
