// SPDX-License-Identifier: Apache-2.0
// The state machine of the group (PLCopen Motion Control part 4): its state, how a stop in progress will end, and the
// error that is reported. It only keeps them; the other classes decide. The picture is in docs/robot.md.

#pragma once

#include <indurop/robot/controller.h>

namespace indurop::robot {

class GroupStates {
 public:
  // A command lets the tool press; it begins or ends, and accepts no motions.
  enum class Press { Off, On, Changing };

  [[nodiscard]] GroupState state() const noexcept { return state_; }
  [[nodiscard]] bool is(GroupState state) const noexcept { return state_ == state; }
  [[nodiscard]] bool moving() const noexcept { return state_ == GroupState::Moving; }
  [[nodiscard]] bool stopping() const noexcept { return state_ == GroupState::Stopping; }
  // Returns whether the drives have power.
  [[nodiscard]] bool powered() const noexcept {
    return state_ != GroupState::Disabled && state_ != GroupState::ErrorStop;
  }
  // Returns whether no motion of the group is possible before it is in Standby again, or it is in Standby.
  [[nodiscard]] bool resting() const noexcept {
    return state_ == GroupState::Standby || state_ == GroupState::Disabled;
  }
  [[nodiscard]] bool busy() const noexcept {
    return state_ == GroupState::Moving || state_ == GroupState::Homing || state_ == GroupState::Stopping;
  }

  // The end of a stop: in ErrorStop, in Disabled, or else in Standby.
  [[nodiscard]] bool to_error() const noexcept { return to_error_; }
  [[nodiscard]] bool to_disabled() const noexcept { return to_disabled_; }
  // Returns whether the stop follows the path.
  [[nodiscard]] bool on_path() const noexcept { return on_path_; }
  // Returns whether the cause of a stop has to remain known until a reset.
  [[nodiscard]] bool failed() const noexcept { return state_ == GroupState::ErrorStop || to_error_; }

  // Transitions.
  void move(bool by_job = false) noexcept {
    state_ = GroupState::Moving;
    by_job_ = by_job_ || by_job;
    press_stopped_ = false;
  }
  void home() noexcept { state_ = GroupState::Homing; }
  void stop() noexcept { state_ = GroupState::Stopping; }
  void stop_to_disabled() noexcept {
    state_ = GroupState::Stopping;
    to_disabled_ = true;
  }
  void stop_to_error(ErrorCode code, int axis) noexcept {
    state_ = GroupState::Stopping;
    to_error_ = true;
    error_ = code;
    error_axis_ = axis;
  }
  void leave_path(bool left = true) noexcept { on_path_ = !left; }
  // The stop has ended; the state after it is set by one of the following functions.
  void end_stop() noexcept {
    to_error_ = to_disabled_ = false;
    on_path_ = true;
  }
  void error_stop() noexcept { state_ = GroupState::ErrorStop; }
  void disable() noexcept { state_ = GroupState::Disabled; }
  void stand_by() noexcept { state_ = GroupState::Standby; }
  // All motion has ended: the next one begins on its path.
  void end_motion() noexcept {
    on_path_ = true;
    by_job_ = false;
  }

  [[nodiscard]] bool moving_by_job() const noexcept { return by_job_ && moving(); }
  [[nodiscard]] ErrorCode error() const noexcept { return error_; }
  [[nodiscard]] int error_axis() const noexcept { return error_axis_; }
  // Sets the reported error, unless the cause of a stop has to remain known.
  void report(ErrorCode code, int axis) noexcept {
    error_ = failed() ? error_ : code;
    report_axis(axis);
  }
  void report_axis(int axis) noexcept { error_axis_ = failed() ? error_axis_ : axis; }
  // The error that is reported before the first service.
  void report_first(ErrorCode code) noexcept { error_ = code; }

  [[nodiscard]] bool pressing() const noexcept { return press_ != Press::Off; }
  [[nodiscard]] Press press() const noexcept { return press_; }
  void set_press(Press press) noexcept { press_ = press; }
  void end_press(bool by_stop) noexcept {
    press_ = Press::Off;
    press_stopped_ = by_stop;
  }
  // Returns whether the last motion of the group was a press that a stop has ended: nothing can resume it.
  [[nodiscard]] bool press_stopped() const noexcept { return press_stopped_; }

  // The emergency stop input.
  [[nodiscard]] bool emergency() const noexcept { return emergency_; }
  void set_emergency(bool emergency) noexcept { emergency_ = emergency; }

 private:
  GroupState state_ = GroupState::Disabled;
  ErrorCode error_ = ErrorCode::Ok;
  int error_axis_ = 0;
  bool to_error_ = false;
  bool to_disabled_ = false;
  bool on_path_ = true;
  bool by_job_ = false;
  bool emergency_ = false;
  Press press_ = Press::Off;
  bool press_stopped_ = false;
};

}  // namespace indurop::robot
