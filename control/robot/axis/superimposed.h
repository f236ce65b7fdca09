// SPDX-License-Identifier: Apache-2.0
// A motion superimposed on the motion of a single axis: its own motion, following another axis, or standstill. The sum
// keeps the limits of the axis: what they do not allow at once comes later. A shift of the master, as seen by its
// follower, takes the same place.

#pragma once

#include <indurop/robot/commands.h>

#include "control/robot/axis/answers.h"
#include "control/robot/axis/body.h"
#include "control/robot/axis/resolver.h"

namespace indurop::robot {

class SuperimposedMotion {
 public:
  SuperimposedMotion(AxisParts& parts, AxisAnswers& answers) noexcept
      : parts_(parts), answers_(answers), resolver_(parts) {}

  // The motion under it: whether another one waits, and whether it goes to a position.
  struct Own {
    bool waits = false;
    bool to_position = false;
  };
  // Real-time safe, like all functions of this class.
  void begin(int ticket, const Command& command, const Own& own) noexcept;
  void halt(int ticket, const Command& command) noexcept;
  void shift_master(int ticket, const Command& command) noexcept;
  // Ends it, with this result.
  void end(ErrorCode code) noexcept { answers_.finish(owner_, code); }
  void end_request() noexcept;
  // Ends it once it has been done.
  void note() noexcept;

 private:
  [[nodiscard]] ErrorCode check(const Command& command, const Own& own) const noexcept;
  [[nodiscard]] ErrorCode check_shift(const Command& command) const noexcept;
  void take(int ticket, AxisService service) noexcept;

  AxisParts& parts_;
  AxisAnswers& answers_;
  CommandResolver resolver_;
  AxisOwner owner_;
};

}  // namespace indurop::robot
