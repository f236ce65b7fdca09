// SPDX-License-Identifier: Apache-2.0
// Continues jobs that a stop, an error or a pause interrupted: slowly back to the path, then on. Also single steps
// back. The follower keeps the path, Plans what was to be planned.

#pragma once

#include <array>

#include "control/robot/group/group_port.h"
#include "control/robot/group/path_correction.h"
#include "control/robot/group/plans.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class Resuming {
 public:
  enum class Return { None, ToPath, Back, FromInterrupt };

  Resuming(Robot& robot, GroupPort& group, Plans& plans, PathCorrection& correction) noexcept
      : robot_(robot), group_(group), plans_(plans), correction_(correction) {}

  // Returns whether a job can be resumed. Real-time safe, like all functions of this class.
  [[nodiscard]] bool aside() const noexcept { return aside_; }
  // Keeps the running job; it is about to stop.
  void set_aside() noexcept;
  // The same for a job whose path is kept already; `asked`: a plan was being made for it.
  void set_aside(int tool, bool asked) noexcept;
  // LineBreakpoints the job: the robot is at standstill, and no motion of the job is in progress.
  void pause() noexcept;
  void drop() noexcept;
  // Services: JobResume, and JobBack, which goes back one motion in a job that pauses between two motions.
  ErrorCode resume() noexcept;
  ErrorCode step_back() noexcept;

  // MoveCommand::source of the motion with which the job can be resumed; 0: none.
  [[nodiscard]] int kept_source() const noexcept {
    return continued_source(robot_.follower.kept_path(), asked_ ? &plans_.request() : nullptr, plans_.ahead());
  }
  // The way back that is being followed.
  [[nodiscard]] Return way_back() const noexcept { return return_; }
  void cancel_way_back() noexcept { return_ = Return::None; }
  // Begins the way back to where an interrupt left the path.
  void begin_from_interrupt(const Joints& to) noexcept;
  // The way back could not be planned. Returns whether another one is requested: straight in joint space instead of on
  // the workpiece.
  [[nodiscard]] bool try_joints() noexcept;
  // The robot is where the job left its path, or one motion further back.
  void end_way_back() noexcept;
  [[nodiscard]] bool is_near(const Joints& place) const noexcept;
  // Requests the space for the rest of a path. Returns false if it has to wait, or if that is a deadlock.
  [[nodiscard]] bool may_continue(const KeptPath& path) noexcept;
  // The job continues on its path; `asked`: it has to request its last plan again.
  void continue_on_path(bool asked) noexcept;

  // Remembers a motion that is being planned, for steps back; forgets all of them: none is possible across it.
  void note(const MoveCommand& command, const Joints& from) noexcept;
  // The same for lines that are followed as one path: back it goes from one to the next.
  void note(const Chain& lines, double acceleration, const Joints& from) noexcept;
  void forget_steps() noexcept { passed_known_ = 0; }

 private:
  struct Passed {
    MoveCommand command;
    Target from;
  };
  void note(const Passed& passed) noexcept;
  [[nodiscard]] double speed_to(const Joints& to) const noexcept;
  void ask_for_way_back(const Joints& to) noexcept;
  void ask_in_joint_space() noexcept;
  void ask(MoveCommand back) noexcept;
  void say_how_far(const Joints& to) noexcept;

  Robot& robot_;
  GroupPort& group_;
  Plans& plans_;
  PathCorrection& correction_;
  bool aside_ = false;
  int aside_tool_ = 0;
  bool asked_ = false;  // a plan was being made
  Return return_ = Return::None;
  bool on_workpiece_ = false;  // the way back is a line on the workpiece
  Joints back_to_ = Joints::Zero();
  std::array<Passed, 32> passed_;
  std::size_t passed_count_ = 0;
  std::size_t passed_known_ = 0;  // the last ones of them, which were not overwritten
};

}  // namespace indurop::robot
