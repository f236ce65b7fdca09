// SPDX-License-Identifier: Apache-2.0
// The motions of one axis as a single axis, as they were commanded: which one is in progress, which ones wait, which
// command ends which, and how each of them begins and ends.

#pragma once

#include <indurop/robot/commands.h>

#include "control/robot/axis/answers.h"
#include "control/robot/axis/body.h"
#include "control/robot/axis/queue.h"
#include "control/robot/axis/resolver.h"
#include "control/robot/axis/service.h"
#include "control/robot/axis/superimposed.h"

namespace indurop::robot {

class AxisMotions {
 public:
  AxisMotions(AxisParts& parts, AxisAnswers& answers) noexcept
      : parts_(parts), answers_(answers), resolver_(parts), superimposed_(parts, answers) {}

  // Takes a command for a motion, which begins at once or waits. Real-time safe, like all functions of this class.
  void take(int ticket, const Command& command) noexcept;
  // Stops, and stays stopped as long as the command has its Execute.
  void take_stop(int ticket, const Command& command) noexcept;
  // Leaves the axes that it follows, and continues with its present speed.
  void decouple(int ticket) noexcept;
  void superimpose(int ticket, const Command& command) noexcept {
    superimposed_.begin(ticket, command, {!queue_.empty(), is_to_position()});
  }
  [[nodiscard]] SuperimposedMotion& superimposed() noexcept { return superimposed_; }
  // Ends what the last request waits for.
  void end_request() noexcept;

  void home() noexcept;
  // Comes to rest, whatever was commanded.
  void halt() noexcept;
  void fail(ErrorCode code, double hardness) noexcept;
  // The axis is no longer held by a stop.
  void release_stop() noexcept;
  [[nodiscard]] bool waits() const noexcept { return !queue_.empty(); }

  // Called once per period, in this order. Blocks may change commands that they have issued.
  void update() noexcept;
  void step_home(double seconds) noexcept;
  void step(double seconds) noexcept;
  void note_ends() noexcept;

 private:
  [[nodiscard]] bool is_to_position() const noexcept { return is_move(owner_.service); }
  [[nodiscard]] ErrorCode check(const Command& command) const noexcept;
  void begin(int ticket, const Command& command) noexcept;
  void begin_motion(const Command& command, const AxisOrder& order) noexcept;
  void begin_own(const Command& command, const AxisOrder& order) noexcept;
  void begin_torque(const AxisOrder& order) noexcept;
  void begin_profile(const Command& command) noexcept;
  void couple(const Command& command, const AxisOrder& order) noexcept;
  void end_motion(ErrorCode code) noexcept;
  void begin_next() noexcept;
  void stop_with(ErrorCode code) noexcept;
  void give_back() noexcept;
  void choose_passing() noexcept;
  [[nodiscard]] double passing_into_next() const noexcept;

  void step_coupled(double seconds) noexcept;
  void step_own(double seconds) noexcept;
  void step_over(double seconds) noexcept;
  void step_torque(double seconds) noexcept;
  [[nodiscard]] ErrorCode guard(double seconds) const noexcept;
  void stop_own(ErrorCode code) noexcept;
  void note_velocity() noexcept;
  void note_superimposed() noexcept;
  void note_rest() noexcept;

  AxisParts& parts_;
  AxisAnswers& answers_;
  CommandResolver resolver_;
  SuperimposedMotion superimposed_;
  CommandQueue queue_;
  AxisOwner owner_;              // of the motion in progress
  int stop_ = AxisOwner::kNone;  // the stop that holds the axis
  double began_at_ = 0;          // where the motion in progress began
  double added_to_ = 0;          // what MoveAdditive adds to
  double homing_ = 0;            // s
};

}  // namespace indurop::robot
