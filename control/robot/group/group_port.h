// SPDX-License-Identifier: Apache-2.0
// The functions of the group that its classes use of each other: a class that finds an error or ends a motion reports
// it here, and need not know which other classes have to stop. Group passes each call on to the class that owns the
// state.

#pragma once

#include <indurop/robot/words.h>

#include "control/robot/kinematics/errors.h"

namespace indurop::robot {

class GroupPort {
 public:
  virtual ~GroupPort() = default;
  // All functions are real-time safe.

  // Stops everything because of an error, on the path if that can still be followed. `why`: the text for the job's
  // message, which must outlive the group; null: the error's own.
  virtual void trip(ErrorCode code, int axis, double hardness, const char* why) noexcept = 0;
  void trip(ErrorCode code, int axis, double hardness) noexcept { trip(code, axis, hardness, nullptr); }
  // The path or a set point is not possible, so the axes leave the path.
  virtual void fall_off(ErrorCode code, int axis) noexcept = 0;
  // Comes to rest on the path, then enters ErrorStop.
  virtual void stop_for(const Fault& fault) noexcept = 0;
  // A thread has crashed, so the task has to end.
  virtual void break_down(const char* what, const char* how) noexcept = 0;

  // Ends the service that is being executed, if there is one.
  virtual void finish_service(const Fault& result) noexcept = 0;
  void finish_service(ErrorCode code) noexcept { finish_service(Fault{code}); }
  [[nodiscard]] virtual bool is_serving() const noexcept = 0;

  // Checks whether a service may move the robot, which it may not while a job does.
  [[nodiscard]] virtual ErrorCode may_move() const noexcept = 0;
  // Returns whether all commanded motions have ended.
  [[nodiscard]] virtual bool settled() const noexcept = 0;
  // Speed limit of the tip and of the arm's end in m/s; HUGE_VAL: none.
  [[nodiscard]] virtual double tip_limit() const noexcept = 0;
  // Selects a tool when all motions have ended. Returns false if it is not done yet: an abandoned plan, made for the
  // tool before, may still be in use.
  virtual bool change_tool(int tool) noexcept = 0;

  // Discards all motions that are not followed yet; commands end with Aborted.
  virtual void forget_plans() noexcept = 0;
  // Ends the motions of commands: the first one with this code, the others with Aborted.
  virtual void drop_motions(ErrorCode first) noexcept = 0;
  // Keeps an interrupted job for later, or discards it.
  virtual void set_job_aside() noexcept = 0;
  virtual void drop_aside() noexcept = 0;
  // All motion has ended: whatever belonged to it ends too. come_to_standby() also enters Standby.
  virtual void end_motion() noexcept = 0;
  virtual void come_to_standby() noexcept = 0;
};

}  // namespace indurop::robot
