// SPDX-License-Identifier: Apache-2.0
// One commanded motion as a path: where the robot is at each place of it. A path is measured in seconds at full speed,
// so that paths of joints, lines and circles can follow each other and share one speed, 1 at most.

#pragma once

#include <optional>

#include "robot/clearance.h"
#include "robot/dynamics.h"
#include "robot/inverse.h"
#include "robot/joint_timing.h"
#include "robot/pace.h"
#include "robot/path_timing.h"
#include "robot/profile.h"
#include "robot/tip_speed.h"
#include "robot/tool_path.h"
#include "robot/workspace.h"

namespace indurop::robot {

// Splines have one command for each of their points.
enum class Move : std::uint8_t { Joint, Line, Circle, Spline };

// Where to go: joint angles or a pose of the tool.
struct Target {
  bool is_pose = false;
  Joints joints = Joints::Zero();
  Pose pose;
  std::optional<std::uint8_t> posture;  // of a pose reached by a joint motion; default: the nearest
  Held held = 0;                        // axes of a pose that are to stand where `joints` says
  const Solutions* known = nullptr;     // of a pose, where they take long to find; their owner keeps them
};

struct MoveCommand {
  Move move = Move::Joint;
  Target target;
  Target mid;                // of circles
  bool more = false;         // of splines: there are points behind this one
  double speed = 1;          // part of full speed, above 0 to 1
  double tool_speed = 0;     // m/s, of lines and circles instead of `speed`; 0: none
  double acceleration = 1;   // part of the full accelerations and jerks, above 0 to 1
  double zone = 0;           // m, how far before the target the path may already turn to the next one
  bool straight = false;     // of joint motions: all joints in step, on a straight line between joint angles
  int source = 0;            // the caller's name for it
  std::uint32_t ticket = 0;  // its number among the motions of a job, from 1
  bool alone = false;        // is not made one path with the lines around it
};

struct Segment {
  Move move = Move::Joint;
  bool timed = false;  // the timing is taken
  bool left = false;   // it was put aside once, and is followed more gently since
  int source = 0;
  std::uint32_t ticket = 0;
  Joints from = Joints::Zero();
  Joints to = Joints::Zero();
  Pose start;
  Pose end;
  Vec3 turn = Vec3::Zero();  // rotation vector from start to end, in the start's frame
  Vec3 center = Vec3::Zero(), radius_x = Vec3::Zero(), radius_y = Vec3::Zero();  // of circles
  double angle = 0;                                                              // of circles, from radius_x on
  const ToolPath* chain = nullptr;                                               // many pieces; its owner keeps it
  double way = 0;                                                                // m, of lines and circles
  double length = 0;                                                             // s at full speed
  double zone = 0;                                                               // m
  // m/s of the tool's tip or of the arm's end, what is faster, at full speed; of joint motions whose axes arrive
  // together it is known once they begin.
  double tip_speed = 0;
  double acceleration = 1;  // part of the joints' accelerations and jerks that it is to take
  LineLimits most;          // of the speed along it, as the tool and the command allow
  LineLimits limits;        // the same as the joints allow too
  // Of lines and circles from rest to rest: as fast as the joints allow at each place. While it is taken, places and
  // length are seconds of the timing, and `pace_limits` limits changes of it, not `limits`.
  PathTiming timing;
  double timing_tip_speed = 0;
  PaceLimits pace_limits;
  double stretch = 0;  // what `length` is otherwise
  // Of joint motions. Those that may come together have a timing too, which is another path; it is made where they
  // begin, for a pace. At the full pace it leaves nothing for changes of it, else it does so up to `fastest` from
  // `settled` on.
  bool together = false;
  JointTiming joint_timing;
  double made_for = 1;
  double fastest = 1;
  double settled = 0;
  bool moving = false;  // begins while the joints move
  // Of joints that arrive together: part of full speed, and how many times as long torques make it.
  double speed = 1;
  double slowness = 1;

  // Of joint motions. `place` is from 0 to length. Real-time safe, as all here.
  [[nodiscard]] Joints joints_at(double place) const noexcept;
  // Of lines and circles.
  [[nodiscard]] Pose pose_at(double place) const noexcept;
  // The same by how far it is on the path, whether the timing is taken or not.
  [[nodiscard]] Pose pose_on_path(double along) const noexcept;
  // A joint motion to there, at part of full speed, whose axes arrive together.
  static Segment together_to(const Joints& to, double speed) noexcept;
  // What the tool and the command allow of the speed at a place, whether the timing is taken or not.
  [[nodiscard]] LineLimits most_at(double place) const noexcept { return chain ? chain->limits_at(place) : most; }
  // Its part of the limits, of joint motions.
  [[nodiscard]] JointLimits slowed(const JointLimits& joints) const noexcept;
  // From rest, at its beginning.
  void take_timing() noexcept;
  // Of joint motions, from any state. The limits are the joints'.
  void take_joint_timing(const JointState& state, const JointLimits& joints, double pace) noexcept;
  // m per s at full speed
  [[nodiscard]] double pace() const noexcept { return length > 0 ? way / length : 0; }
};

// How far a motion has been followed.
struct PathPlace {
  std::uint32_t ticket = 0;  // of the motion; 0: none
  double gone = 0;           // m, since its beginning
  double left = 0;           // m
  double to_go = 0;          // s, as things are
};

// Where two paths meet with a zone: from `zone` before the end of the first to `zone` behind the start of the second.
// The first one fades out while the second fades in, with continuous acceleration.
struct Blend {
  double zone = 0;       // s at full speed, on either side
  LineLimits limits;     // velocity: what it is passed with
  double tip_speed = 0;  // m/s, as that of a segment; not less than that of both
  [[nodiscard]] double length() const noexcept { return 2 * zone; }
  // How far beyond its end the first one is (not positive), and the second beyond its start.
  void parts_at(double place, double& first, double& second) const noexcept;
};

// Joint angles on the paths, for which lines and circles need the inverse kinematics.
class Places {
 public:
  Places(const Arm& arm, const Inverse& inverse, const Workspace& box = {}, const Clearance& clearance = {})
      : arm_(&arm), inverse_(&inverse), box_(box), clearance_(clearance) {}
  // What its motions weigh; it stays where it is, and null is nothing. Nothing is planned.
  void weigh(const Dynamics* dynamics) noexcept { dynamics_ = dynamics; }
  // Null: torques have no limits.
  [[nodiscard]] const Dynamics* dynamics() const noexcept { return dynamics_; }
  // The same arm with another tool. Nothing is planned or followed.
  void take(const Arm& arm, const Inverse& inverse, int tool) noexcept {
    arm_ = &arm;
    inverse_ = &inverse;
    tool_ = tool;
  }
  // Other bodies, and those before for them. Nothing is planned or followed.
  void swap(Clearance& clearance) noexcept { std::swap(clearance_, clearance); }
  // What has to stay clear of what, and the number of the tool that is held.
  [[nodiscard]] const Clearance& clearance() const noexcept { return clearance_; }
  [[nodiscard]] int tool() const noexcept { return tool_; }
  [[nodiscard]] const Arm& arm() const noexcept { return *arm_; }
  [[nodiscard]] const Workspace& box() const noexcept { return box_; }
  // Whether a joint motion stays in it all the way, as far as `parts` places show.
  [[nodiscard]] bool inside(const Segment& segment, int parts) const noexcept;
  [[nodiscard]] const Inverse& inverse() const noexcept { return *inverse_; }

  // The joint angles nearest to `near`. Other than Ok leaves `q` alone. Paths of joints have posture 0.
  Reach on(const Segment& segment, double place, const Joints& near, Joints& q) const noexcept;
  Reach on(const Segment& segment, double place, const Joints& near, Solution& solution) const noexcept;
  // Of lines and circles, by how far it is on the path.
  Reach on_path(const Segment& segment, double along, const Joints& near, Joints& q) const noexcept;
  Reach on(const Segment& first, const Blend& blend, const Segment& second, double place, const Joints& near,
           Joints& q) const noexcept;

 private:
  const Arm* arm_;
  const Inverse* inverse_;
  const Dynamics* dynamics_ = nullptr;
  Workspace box_;
  Clearance clearance_;
  int tool_ = 0;
};

}  // namespace indurop::robot
