// SPDX-License-Identifier: Apache-2.0
// Follows paths in time, with one speed along all of them, whatever they are made of. Override, hold, stop and
// emergency stop change that speed and nothing else, so the robot never leaves its path.

#pragma once

#include "control/robot/kinematics/errors.h"
#include "control/robot/path/brake.h"
#include "control/robot/path/followed_path.h"
#include "control/robot/path/joint_motions.h"

namespace indurop::robot {

class Follower {
 public:
  static constexpr double kStill = FollowedPath::kStill;  // an override below this is a hold

  Follower(const Places& places, const JointLimits& limits) noexcept
      : places_(places), joint_motions_(places, limits), path_(places), brake_(limits) {}

  // Rests at these joint positions, with nothing to do.
  void reset(const Joints& q) noexcept;
  // Returns whether another path can be added; it has to begin at end().
  [[nodiscard]] bool has_room() const noexcept { return !path_.pieces().full() && !stopping(); }
  [[nodiscard]] const Joints& end() const noexcept { return idle() ? q_ : path_.last().to; }
  // `blend`: from the previous segment into this one, if they may be passed without a stop.
  void add(const Segment& segment, const Blend& blend = {}) noexcept;
  // Replaces what is reported of the segment that was added last.
  void set_way(const ToolWay* way) noexcept { path_.set_way(way); }

  // Gives access to the collision check to exchange its bodies. The follower must be idle.
  [[nodiscard]] CollisionCheck& clear_way() noexcept { return joint_motions_.collisions(); }
  // Replaces all remaining motion by a joint motion, from any motion of the joints; not while it is stopping. Errors:
  // JointLimit, Singular, Workspace, Speed, Collision; then nothing has changed.
  Fault redirect(const Segment& target) noexcept;

  // Keeps the rest of the path when it comes to rest or is reset, so that it can be resumed there.
  void keep_path() noexcept;
  [[nodiscard]] const KeptPath& kept_path() const noexcept { return kept_; }
  void set_kept_path(const KeptPath& path) noexcept { kept_ = path; }
  // Resumes the kept path; called when idle and at rest where it was left.
  void resume() noexcept;

  // Part of the planned speed, from 0 to 1.
  void set_override(double part) noexcept;
  // Speed limit of the tool's tip and of the arm's end, in m/s; HUGE_VAL: no such limit. Only while it is idle.
  void set_tip_limit(double speed) noexcept { joint_motions_.set_tip_limit(speed); }
  // Slows down to rest on the path, or resumes.
  void set_hold(bool hold) noexcept;
  // Comes to rest on the path and discards the rest of it, as softly as it moves.
  void stop() noexcept;
  // Does the same as hard as the joints can at this place. `hardness` multiplies their accelerations; of several calls,
  // the greatest value counts.
  void stop_hard(double hardness) noexcept;

  // Advances by one period. Errors: Unreachable, JointLimit, Singular, Speed: the path cannot be followed at this
  // place; joints() is then unchanged.
  Fault step(double seconds) noexcept;

  [[nodiscard]] const Joints& joints() const noexcept { return q_; }
  // Returns whether there is nothing left to do.
  [[nodiscard]] bool idle() const noexcept { return path_.empty(); }
  [[nodiscard]] bool stopping() const noexcept { return mode_ == Mode::Stop || mode_ == Mode::HardStop; }
  // Returns whether there is no motion at this moment, because of a hold or an override of 0, or because it is idle.
  [[nodiscard]] bool at_rest() const noexcept { return idle() || path_.state().velocity <= 0; }
  // Part of full speed.
  [[nodiscard]] double speed() const noexcept { return idle() ? 0 : speed_; }
  // Returns the time to the end of the present path at the present conditions, in s.
  [[nodiscard]] double to_go() const noexcept;
  // Returns the place on the present motion.
  [[nodiscard]] PathPlace path_place() const noexcept { return path_.place(to_go()); }
  // The path that remains to be followed.
  [[nodiscard]] const FollowedPath& path() const noexcept { return path_; }
  // Returns MoveCommand::source of the present path; 0: none.
  [[nodiscard]] int source() const noexcept { return path_.source(); }

 private:
  enum class Mode { Run, Hold, Stop, HardStop };

  [[nodiscard]] double wanted_pace() const noexcept;
  void begin_piece() noexcept;
  void begin_blend() noexcept;
  void next_piece() noexcept;
  void replan() noexcept;
  [[nodiscard]] bool brakes_by_profile() const noexcept;
  Profile pace_of_timing(double seconds) noexcept;
  double advance(double seconds) noexcept;  // returns the distance
  Fault place(double seconds) noexcept;
  Fault brake(double seconds) noexcept;
  // Checks whether the joints may move to this position in that time. Errors: JointLimit, Speed.
  [[nodiscard]] Fault allowed(const Joints& to, double seconds) const noexcept;
  void note_step(double moved) noexcept;
  void note_speed(double seconds) noexcept;

  const Places& places_;
  JointMotions joint_motions_;
  FollowedPath path_;
  KeptPath kept_;
  bool keeps_ = false;  // the path is kept when it ends
  Mode mode_ = Mode::Run;
  double override_ = 1;
  PathBrake brake_;
  PathHistory past_;
  Profile profile_;
  bool to_end_ = false;  // the profile ends at the end of the present piece
  PaceChange pace_;
  double time_ = 0;    // in the profile
  double period_ = 0;  // the last one
  // Speed along the path in seconds at full speed, whether the piece has a timing or not.
  double speed_ = 0;
  Joints q_ = Joints::Zero();
};

}  // namespace indurop::robot
