// SPDX-License-Identifier: Apache-2.0
// One commanded motion as a path: the robot's position at each place of it. Places on a path are measured in seconds at
// full speed, so that paths of joints, lines and circles can follow each other and share one speed, 1 at most.

#pragma once

#include <indurop/robot/space.h>
#include <indurop/robot/tool_way.h>

#include <optional>

#include "control/robot/collision/clearance.h"
#include "control/robot/kinematics/dynamics.h"
#include "control/robot/kinematics/inverse.h"
#include "control/robot/kinematics/tip_speed.h"
#include "control/robot/kinematics/workspace.h"
#include "control/robot/path/joint_path.h"
#include "control/robot/path/joint_timing.h"
#include "control/robot/path/pace.h"
#include "control/robot/path/profile.h"
#include "control/robot/path/timing.h"
#include "control/robot/path/tool_path.h"
#include "control/robot/path/wave.h"

namespace indurop::robot {

// Splines have one command for each of their points. Free: around obstacles, on a path of the joints that is searched
// for.
enum class Move : std::uint8_t { Joint, Line, Circle, Spline, Free };
// Whether the path is one of the joints: the tool has none that could be measured, shifted or waved.
constexpr bool is_of_joints(Move move) noexcept {
  return move == Move::Joint || move == Move::Free;
}

// The target of a motion: joint angles or a pose of the tool.
struct Target {
  bool is_pose = false;
  Joints joints = Joints::Zero();
  Pose pose;
  std::optional<std::uint8_t> posture;  // of a pose reached by a joint motion; default: the nearest
  Held held = 0;                        // axes of a pose that keep their values in `joints`
  const Solutions* known = nullptr;     // of a pose whose solutions take long to find; not owned
};

// s that the search for a free motion may take: at most, and if its command does not say.
inline constexpr double kLongestSearch = 600, kUsualSearch = 10;

struct MoveCommand {
  Move move = Move::Joint;
  Target target;
  Target mid;                // of circles
  bool more = false;         // of splines: more points follow this one
  double speed = 1;          // part of full speed, above 0 to 1
  double tool_speed = 0;     // m/s, of lines and circles instead of `speed`; 0: none
  double acceleration = 1;   // part of the full accelerations and jerks, above 0 to 1
  double zone = 0;           // m, how far before the target the path may already turn to the next one
  bool straight = false;     // of joint motions: all joints in step, on a straight line between joint angles
  int source = 0;            // number that the caller uses for it
  std::uint32_t ticket = 0;  // its number among the motions of a job, from 1
  bool alone = false;        // is not joined with neighbouring lines into one path
  bool exact = false;        // of lines: rejected unless it leads to the joints of the target, too
  Wave wave{};               // across lines, circles and splines
  std::uint32_t seed = 0;    // of a search for a way
  double within = 0;         // s, that this search may take; 0: any time
  int sync = -1;             // begins together with motions of other robots that have this name; -1: alone
};

struct Segment {
  Move move = Move::Joint;
  bool timed = false;  // the timing is in use
  bool left = false;   // it was interrupted once, and is followed more gently since then
  int source = 0;
  std::uint32_t ticket = 0;
  Joints from = Joints::Zero();
  Joints to = Joints::Zero();
  Pose start;
  Pose end;
  Vec3 turn = Vec3::Zero();  // rotation vector from start to end, in the start's frame
  Vec3 center = Vec3::Zero(), radius_x = Vec3::Zero(), radius_y = Vec3::Zero();  // of circles
  double angle = 0;                                                              // of circles, from radius_x on
  // Whether axes that the pose of the tool leaves undetermined move, uniformly from `from` to `elbow`; else they stay.
  bool elbow_moves = false;
  Joints elbow = Joints::Zero();          // only these axes count
  const ToolPath* chain = nullptr;        // many pieces; not owned
  const JointPath* joint_path = nullptr;  // of Move::Free; not owned
  double way = 0;                         // m, of lines and circles
  double length = 0;                      // s at full speed
  double zone = 0;                        // m
  Wave wave;                              // added to pose_at()
  // m/s of the tool's tip or of the arm's end, whichever is faster, at full speed; for joint motions whose axes arrive
  // together it is known when they begin.
  double tip_speed = 0;
  double acceleration = 1;  // part of the joints' accelerations and jerks that it may use
  LineLimits most;          // limits of the speed along it set by the tool and the command
  LineLimits limits;        // the same with the limits of the joints
  // The timing of lines and circles from rest to rest: as fast as the joints allow at each place. While it is in use,
  // places and length are seconds of the timing, and changes of it are limited by `pace_limits`, not by `limits`.
  PathTiming timing;
  double timing_tip_speed = 0;
  PaceLimits pace_limits;
  double stretch = 0;  // `length` without the timing
  // For joint motions. Those whose axes may arrive together also have a timing, which is another path; it is made when
  // they begin, for one pace. At full pace it leaves nothing for changes of the pace, otherwise it does so up to
  // `fastest`, from `settled` on.
  bool together = false;
  JointTiming joint_timing;
  double made_for = 1;
  double fastest = 1;
  double settled = 0;
  bool moving = false;  // begins while the joints move
  // For joints that arrive together: part of full speed, and the factor by which torque limits lengthen the motion.
  double speed = 1;
  double slowness = 1;
  const SpaceCells* cells = nullptr;   // of the shared space, through which it leads; null: unknown; not owned
  int sync = -1;                       // as MoveCommand::sync
  const ToolWay* way_ahead = nullptr;  // what is reported of it; null: nothing; not owned

  // Position of a joint motion. `place` is from 0 to length. Real-time safe, like all functions of this struct.
  [[nodiscard]] Joints joints_at(double place) const noexcept;
  // Pose of a line or circle.
  [[nodiscard]] Pose pose_at(double place) const noexcept;
  // The same by the distance on the path, whether the timing is in use or not.
  [[nodiscard]] Pose pose_on_path(double along) const noexcept;
  // The same without the wave, and which part of a line or circle that place is.
  [[nodiscard]] Pose calm_at(double along) const noexcept;
  [[nodiscard]] double part_at(double along) const noexcept;
  // Joint values of which those that the pose leaves undetermined count, by the distance on the path.
  [[nodiscard]] Joints elbow_at(double along) const noexcept { return from + part_at(along) * (elbow - from); }
  // The distance on the path, without its wave.
  [[nodiscard]] PathWay way_at(double along) const noexcept;
  // A joint motion to `to`, at part of full speed, whose axes arrive together.
  static Segment together_to(const Joints& to, double speed) noexcept;
  // The part of the joints' limits that a joint motion may use.
  [[nodiscard]] JointLimits slowed(const JointLimits& joints) const noexcept;
  // Limits of the speed along a straight line between joint angles, of nonzero length. `hardness` multiplies the
  // joints' accelerations, its square their jerks.
  [[nodiscard]] LineLimits straight_limits(const JointLimits& joints, double hardness) const noexcept;
  // Switches to the timing; only from rest at the start of the segment.
  void take_timing() noexcept;
  // Makes the timing of a joint motion, from any state. The limits are those of the joints.
  void take_joint_timing(const JointState& state, const JointLimits& joints, double pace) noexcept;
  // s that it takes from rest to rest, for lines and circles.
  [[nodiscard]] double duration() const noexcept;
  // m per s at full speed
  [[nodiscard]] double pace() const noexcept { return length > 0 ? way / length : 0; }
};

// The progress of a motion on its path.
struct PathPlace {
  std::uint32_t ticket = 0;  // of the motion; 0: none
  double gone = 0;           // m, since its start
  double left = 0;           // m
  double to_go = 0;          // s, at the present speed
};

// The transition between two paths: from `zone` before the end of the first to `zone` after the start of the second.
// The first one fades out while the second fades in, with continuous acceleration.
struct Blend {
  double zone = 0;       // s at full speed, on either side
  LineLimits limits;     // velocity: speed in the transition
  double tip_speed = 0;  // m/s, as in a segment; not less than either segment's
  [[nodiscard]] double length() const noexcept { return 2 * zone; }
  // The distance of the first path after its end (not positive), and of the second after its start.
  void parts_at(double place, double& first, double& second) const noexcept;
};

// Joint angles on the paths; lines and circles need the inverse kinematics.
class Places {
 public:
  Places(const Arm& arm, const Inverse& inverse, const Workspace& box = {}, const Clearance& clearance = {})
      : arm_(&arm), inverse_(&inverse), box_(box), clearance_(clearance) {}
  // Sets the masses that its motions move; not owned, null: none. Only while nothing is planned.
  void weigh(const Dynamics* dynamics) noexcept { dynamics_ = dynamics; }
  // Null: torques are not limited.
  [[nodiscard]] const Dynamics* dynamics() const noexcept { return dynamics_; }
  // Selects the same arm with another tool. Only while nothing is planned or followed.
  void take(const Arm& arm, const Inverse& inverse, int tool) noexcept {
    arm_ = &arm;
    inverse_ = &inverse;
    tool_ = tool;
  }
  // Exchanges the bodies with `clearance`. Only while nothing is planned or followed.
  void swap(Clearance& clearance) noexcept { std::swap(clearance_, clearance); }
  // The pairs of bodies that must stay clear of each other, and the number of the selected tool.
  [[nodiscard]] const Clearance& clearance() const noexcept { return clearance_; }
  [[nodiscard]] int tool() const noexcept { return tool_; }
  [[nodiscard]] const Arm& arm() const noexcept { return *arm_; }
  [[nodiscard]] const Workspace& box() const noexcept { return box_; }
  // Returns whether a joint motion stays inside the workspace, checked at `parts` places.
  [[nodiscard]] bool inside(const Segment& segment, int parts) const noexcept;
  [[nodiscard]] const Inverse& inverse() const noexcept { return *inverse_; }

  // The joint angles nearest to `near`. A result other than Ok leaves `q` unchanged. Joint paths have posture 0.
  Reach on(const Segment& segment, double place, const Joints& near, Joints& q) const noexcept;
  Reach on(const Segment& segment, double place, const Joints& near, Solution& solution) const noexcept;
  // `near` with the axes that a pose leaves undetermined where they are on the path, by the distance on it.
  [[nodiscard]] Joints held_at(const Segment& segment, double along, const Joints& near) const noexcept {
    return inverse_->held_as(segment.elbow_moves ? segment.elbow_at(along) : segment.from, near);
  }
  // For lines and circles, by the distance on the path.
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
