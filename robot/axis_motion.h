// SPDX-License-Identifier: Apache-2.0
// Motion of a single axis by itself: to a position, also through it with a velocity, on and on with a velocity, to
// rest; each from whatever it is doing. What is asked for in mid-move may leave less acceleration and jerk than the
// axis needs to keep its speed and its ends: then it brakes harder, as its own limits allow, until they are enough. An
// override slows it down at any moment, to rest at 0, and it goes on when that ends.

#pragma once

#include <cmath>
#include <optional>

#include "robot/profile.h"
#include "robot/time_profile.h"

namespace indurop::robot {

class AxisMotion {
 public:
  // The axis' own limits and ends; none at first. Real-time safe, as all here.
  void set_bounds(const LineLimits& most, double lower, double upper) noexcept;
  // Moving on like this, with nothing to do.
  void reset(const LineState& state) noexcept;
  // Somebody else moves it: it is here, and what is asked for waits until go_on().
  void lend(const LineState& state) noexcept;
  void go_on() noexcept;
  // As fast as the limits allow, also where the way is too short or backwards.
  void move_to(double position, const LineLimits& limits, const LineLimits& braking) noexcept;
  void move_to(double position, const LineLimits& limits) noexcept { move_to(position, limits, limits); }
  // On the way to a position: passes it with a velocity in the direction it has there, not above the axis' own. 0:
  // comes to rest there.
  void pass_with(double velocity) noexcept;
  // Passes a position with a velocity, whose sign says in which direction, and goes on with it (axis_through.cpp). It
  // takes a run-up first where it has to. Once it is on its last way to the position an override may make it pass that
  // with another velocity, but never turns it back.
  void move_through(double position, double velocity, const LineLimits& limits, const LineLimits& braking) noexcept;
  // It has passed this position, and goes on.
  [[nodiscard]] bool went_through(double position) const noexcept;
  void go_on_with(double velocity, const LineLimits& limits, const LineLimits& braking) noexcept;
  // Where it has to come to rest first to do that: before its run-up, or as it turns. None: it goes straight there.
  [[nodiscard]] static std::optional<double> rests_first(const LineState& from, double position, double velocity,
                                                         const LineLimits& limits, const LineLimits& braking) noexcept;
  void move_with(double velocity, const LineLimits& limits) noexcept;
  // As a table says, which begins as the axis is (axis_along.cpp). Then it rests, or goes on with its velocity, once it
  // has no acceleration. No override counts on the way: whoever has one stops it.
  void move_along(const TimeProfile& table, const LineLimits& limits, bool to_rest) noexcept;
  [[nodiscard]] bool along() const noexcept { return goal_ == Goal::Table; }
  [[nodiscard]] bool full_speed() const noexcept { return override_ == 1; }
  void stop(const LineLimits& limits) noexcept;
  // Part of the speed of motions, from 0 to 1; stops are not slowed down.
  void set_override(double part) noexcept;

  void step(double seconds) noexcept;
  // Where that would come to.
  [[nodiscard]] LineState after(double seconds) const noexcept { return on_profile(time_ + seconds); }

  // Position or velocity it goes to, and how fast at most.
  [[nodiscard]] double target() const noexcept { return target_; }
  [[nodiscard]] double speed() const noexcept { return limits_.velocity; }
  [[nodiscard]] const LineState& state() const noexcept { return state_; }
  // Has come to the position, to the velocity, or to rest; not while an override of 0 holds it.
  [[nodiscard]] bool done() const noexcept {
    return !lent_ && !held() && !harder_ && goal_ != Goal::Through && !along() && time_ >= profile_.duration();
  }
  [[nodiscard]] bool at_rest() const noexcept { return done() && state_.velocity == 0 && !passed_; }
  // It is exactly at the position that it passes; `rest_of_step()` seconds of the last step are left.
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
  bool harder_ = false;  // brakes until what is asked for keeps these
  Goal goal_ = Goal::Rest;
  double target_ = 0;  // position or velocity
  LineLimits limits_, braking_;
  double arrival_ = 0;       // what the position is passed with, in the direction of the way there
  double end_velocity_ = 0;  // of a motion through a position
  bool on_last_way_ = false;
  TimeProfile table_;
  bool rests_ = false;  // at the end of the table
  std::optional<double> went_through_;
  bool passing_ = false;
  bool passed_ = false;
  double left_over_ = 0;
  // While it passes a position the profile is a way ahead of `base_`, in the direction of `sign_`; `faster_` follows on
  // it.
  double base_ = 0, sign_ = 1;
  Profile faster_;
  double override_ = 1;
  Profile profile_;
  double time_ = 0;
  LineState state_;
};

}  // namespace indurop::robot
