// SPDX-License-Identifier: Apache-2.0
// Follows paths in time, with one speed along all of them, whatever they are made of. Override, hold, stop and
// emergency stop change that speed and nothing else, so the robot never leaves its path.

#pragma once

#include <array>
#include <cmath>

#include "control/robot/collision/collision_check.h"
#include "control/robot/kinematics/errors.h"
#include "control/robot/path/brake.h"
#include "control/robot/path/segment.h"

namespace indurop::robot {

class Follower final : private PathAhead {
 public:
  static constexpr int kMost = 3;
  static constexpr double kStill = 1e-3;  // an override below this is a hold
  // A path that was left, and the place where it was left.
  struct Aside {
    std::array<Segment, kMost> segments;
    std::array<Blend, kMost> blends;
    int count = 0;
    Blend blend;
    bool in_blend = false;
    double place = 0;
    Joints q = Joints::Zero();
  };

  Follower(const Places& places, const JointLimits& limits) noexcept
      : places_(places), most_(limits), clear_(places.clearance(), false), brake_(limits) {}

  // Rests at these joint positions, with nothing to do.
  void reset(const Joints& q) noexcept;
  // Returns whether another path can be added; it has to begin at end().
  [[nodiscard]] bool has_room() const noexcept { return count_ < kMost && !stopping(); }
  [[nodiscard]] const Joints& end() const noexcept { return count_ > 0 ? segment(count_ - 1).to : q_; }
  // `blend`: from the previous segment into this one, if they may be passed without a stop.
  void add(const Segment& segment, const Blend& blend = {}) noexcept;

  // Gives access to the collision check to exchange its bodies. The follower must be idle.
  [[nodiscard]] CollisionCheck& clear_way() noexcept { return clear_; }
  // Replaces all remaining motion by a joint motion, from any motion of the joints; not while it is stopping. Errors:
  // JointLimit, Singular, Workspace, Speed, Collision; then nothing has changed.
  Fault redirect(const Segment& target) noexcept;

  // Returns whether the next segment may begin without a stop.
  [[nodiscard]] bool goes_over() const noexcept { return count_ > 0 && segment(count_ - 1).zone > 0; }

  // Keeps the rest of the path when it comes to rest or is reset, so that it can be resumed there (follower_aside.cpp).
  void set_aside() noexcept;
  // Returns where that path was left.
  [[nodiscard]] const Joints& aside() const noexcept { return aside_.q; }
  [[nodiscard]] const Aside& path_aside() const noexcept { return aside_; }
  // Replaces the path that was kept.
  void put_aside(const Aside& path) noexcept { aside_ = path; }
  [[nodiscard]] bool has_path_aside() const noexcept { return aside_.count > 0; }
  // Resumes the kept path; called when idle and at rest at aside().
  void go_on() noexcept;

  // Part of the planned speed, from 0 to 1.
  void set_override(double part) noexcept;
  // Speed limit of the tool's tip and of the arm's end, in m/s; HUGE_VAL: no such limit. Only while it is idle.
  void set_tip_limit(double speed) noexcept { tip_limit_ = speed; }
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
  [[nodiscard]] bool idle() const noexcept { return count_ == 0; }
  [[nodiscard]] bool stopping() const noexcept { return mode_ == Mode::Stop || mode_ == Mode::HardStop; }
  // Returns whether there is no motion at this moment, because of a hold or an override of 0, or because it is idle.
  [[nodiscard]] bool at_rest() const noexcept { return idle() || state_.velocity <= 0; }
  // Part of full speed.
  [[nodiscard]] double speed() const noexcept { return idle() ? 0 : speed_; }
  [[nodiscard]] double acceleration() const noexcept { return idle() ? 0 : acceleration_; }
  // Returns the time to the end of the present path at the present conditions, in s.
  [[nodiscard]] double to_go() const noexcept;
  // Returns the place on the present motion.
  [[nodiscard]] PathPlace path_place() const noexcept;
  // Returns MoveCommand::source of the present path; 0: none.
  [[nodiscard]] int source() const noexcept;

 private:
  enum class Mode { Run, Hold, Stop, HardStop };

  [[nodiscard]] const Segment& segment(int i) const noexcept { return segments_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double piece_end() const noexcept;
  [[nodiscard]] const LineLimits& piece_limits() const noexcept;
  [[nodiscard]] Profile into_blend() const noexcept;
  [[nodiscard]] double wanted_pace() const noexcept;
  [[nodiscard]] double pace_for(double tip_speed) const noexcept;
  [[nodiscard]] double measured_tip_speed(const Segment& segment) const noexcept;
  void make_joint_timing(Segment& segment, const JointState& from, const JointLimits& limits, double pace) noexcept;
  void begin_piece() noexcept;
  Reach motion(JointState& now) const noexcept;
  [[nodiscard]] bool can_begin(const JointState& now, double pace, const JointLimits& most) const noexcept;
  bool leave_shares() noexcept;
  [[nodiscard]] double made_for(double pace) const noexcept;
  [[nodiscard]] Fault stays_clear(const Segment& way) noexcept;
  Profile pace_of_timing(double seconds) noexcept;
  void note_place(double seconds) noexcept;
  void note_joints(double seconds) noexcept;
  void try_blend() noexcept;
  void replan() noexcept;
  double advance(double seconds) noexcept;  // returns the distance
  double crossing(double from, double to) const noexcept;
  void next_piece() noexcept;
  Fault place(double seconds) noexcept;
  Fault brake(double seconds) noexcept;
  // Checks whether the joints may move from one position to the other in that time. Errors: JointLimit, Speed.
  [[nodiscard]] Fault allowed(const Joints& from, const Joints& to, double seconds) const noexcept;
  void go(double distance) noexcept;
  void note(double moved) noexcept;
  [[nodiscard]] Reach joints_on_piece(double place, const Joints& near, Joints& q) const noexcept;
  Reach joints_ahead(double distance, const Joints& near, Joints& q) const noexcept override;
  [[nodiscard]] double left() const noexcept override;
  [[nodiscard]] bool has_shape() const noexcept override { return segment(0).timed && segment(0).move == Move::Joint; }
  [[nodiscard]] Shape shape_ahead(double distance) const noexcept override;
  [[nodiscard]] double smooth_until(double distance) const noexcept override;
  [[nodiscard]] bool is_timed() const noexcept override { return segment(0).timed && segment(0).move != Move::Joint; }
  [[nodiscard]] Timed timed_ahead(double distance) const noexcept override;
  Reach joints_on_path(double along, const Joints& near, Joints& q) const noexcept override;

  void put_aside() noexcept;

  const Places& places_;
  JointLimits most_;
  CollisionCheck clear_;  // for paths that are chosen in the tick
  Aside aside_;
  bool keep_ = false;
  std::array<Segment, kMost> segments_;
  std::array<Blend, kMost> blends_;  // into each of them
  int count_ = 0;
  Blend blend_;            // between the first two segments; zone 0: none
  bool in_blend_ = false;  // the present piece is the blend, not the first segment
  Mode mode_ = Mode::Run;
  double override_ = 1;
  double tip_limit_ = HUGE_VAL;
  PathBrake brake_;
  PathHistory past_;
  Profile profile_;
  bool to_end_ = false;  // the profile ends at the end of the present piece
  PaceChange pace_;
  double time_ = 0;    // in the profile
  double period_ = 0;  // the last one
  LineState state_;    // position: place on the present piece
  // Speed and acceleration along the path in seconds at full speed, whether the piece has a timing or not, and the last
  // places on a piece with a timing.
  double speed_ = 0;
  double acceleration_ = 0;
  std::array<double, 3> passed_{};
  Joints q_ = Joints::Zero();
};

}  // namespace indurop::robot
