// SPDX-License-Identifier: Apache-2.0
// Geometry and limits of an arm: the pose of its tool, and how it moves with the axes. Axes are stored as lines in the
// base's frame with all joints at zero (product of exponentials); every URDF can be converted to this form.
//
// If axes turn the workpiece (a positioner), the base is the workpiece: the chain leads from it through these axes to
// the world, and from there through those of the arm to the tool. So paths of the tool are paths on the workpiece.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>

#include "control/robot/kinematics/delta.h"

namespace indurop::robot {

enum class AxisKind : std::uint8_t { Turning, Sliding };

struct Axis {
  std::string name;
  Vec3 direction = Vec3::UnitZ();  // unit vector
  Vec3 point = Vec3::Zero();       // a point on the axis
  double lower = -kPi;             // rad; m for sliding axes, here and below
  double upper = kPi;
  bool endless = false;  // turns without end; lower and upper are ignored
  AxisKind kind = AxisKind::Turning;
  double farthest = HUGE_VAL;  // rad from 0 that the drive of an endless axis counts, in each direction
  [[nodiscard]] bool slides() const noexcept { return kind == AxisKind::Sliding; }
  // The ends of its range; of an endless axis, those of what its drive counts.
  [[nodiscard]] double lowest() const noexcept { return endless ? -farthest : lower; }
  [[nodiscard]] double highest() const noexcept { return endless ? farthest : upper; }
};

// A joint of the chain: an axis itself, or a joint that a linkage moves with it.
struct Link {
  Vec3 direction = Vec3::UnitZ();
  Vec3 point = Vec3::Zero();
  AxisKind kind = AxisKind::Turning;
  int axis = 0;
  double ratio = 1;  // motion of this joint per motion of the axis
};

// Rotation and shift of a part of the chain, relative to its pose with all joints at zero.
struct ChainFrame {
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
};

// Maximum values of the axes.
struct JointLimits {
  Joints velocity = Joints::Constant(1);      // rad/s
  Joints acceleration = Joints::Constant(4);  // rad/s^2
  Joints jerk = Joints::Constant(40);         // rad/s^3
};

// Returns limits with accelerations and jerks multiplied by `part`.
inline JointLimits gentler(JointLimits limits, double part) noexcept {
  limits.acceleration *= part;
  limits.jerk *= part;
  return limits;
}

using ChainFrames = std::array<ChainFrame, 17>;

class Arm {
 public:
  using Axes = std::array<Axis, kAxes>;
  static constexpr std::size_t kMostLinks = std::tuple_size_v<ChainFrames> - 1;

  // `home` is the tool's pose with all joints at zero.
  Arm(Axes axes, const Pose& home, int count = 6) noexcept;
  // The chain from base to tool consists of `links`, at most kMostLinks. The first `world_joint` of them move the
  // workpiece.
  Arm(Axes axes, const Pose& home, int count, const Link* links, std::size_t link_count, int world_joint = 0) noexcept;

  // A delta of three arms; with four axes, the fourth turns its tool.
  Arm(Axes axes, const Delta& delta, int count) noexcept;

  // Returns the same arm with a tool; `tool` is its pose in the frame of the arm's end.
  [[nodiscard]] Arm with_tool(const Pose& tool) const noexcept;

  [[nodiscard]] int count() const noexcept { return count_; }
  [[nodiscard]] const Axis& axis(int index) const noexcept { return axes_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const Axes& axes() const noexcept { return axes_; }
  [[nodiscard]] const Pose& home() const noexcept { return home_; }
  // Returns whether the arm is a serial chain of six turning axes.
  [[nodiscard]] bool turns_six() const noexcept;
  // Returns the number of the frame of the world: 0, the base's, unless axes turn the workpiece.
  [[nodiscard]] int world_joint() const noexcept { return world_joint_; }
  // Returns whether this axis moves the workpiece, not the arm. They are the last axes.
  [[nodiscard]] bool moves_workpiece(int axis) const noexcept { return axis >= count_ - world_joint_; }
  // Sets Axis::farthest.
  void end_at(int axis, double farthest) noexcept { axes_[static_cast<std::size_t>(axis)].farthest = farthest; }
  // Returns the same arm without the axes of the workpiece. Its base's frame stands still where the workpiece is with
  // these axes at zero.
  [[nodiscard]] Arm in_world() const noexcept;
  // Real-time safe, like all functions below.
  [[nodiscard]] Pose forward(const Joints& q) const noexcept;
  // Returns the position of the arm's own end when the tool is at this pose.
  [[nodiscard]] Vec3 end_of(const Pose& tool) const noexcept { return tool.position + tool.orientation * end_; }
  // Returns where the world is as seen from the workpiece: the pose of the base's frame of in_world().
  [[nodiscard]] ChainFrame world(const Joints& q) const noexcept;
  // Computes the frame after each joint of the chain; the first frame is the base's.
  void frames(const Joints& q, ChainFrames& frames) const noexcept;
  // Returns the number of joints of the chain; 0 for a delta, which has no chain.
  [[nodiscard]] int chain_length() const noexcept { return static_cast<int>(link_count_); }
  [[nodiscard]] const Link& link(int index) const noexcept { return links_[static_cast<std::size_t>(index)]; }
  // Returns the Jacobian of the tool's point, in the base's frame.
  [[nodiscard]] Jacobian jacobian(const Joints& q) const noexcept {
    Pose tool;
    return jacobian(q, tool);
  }
  // Also returns the pose of the tool.
  [[nodiscard]] Jacobian jacobian(const Joints& q, Pose& tool) const noexcept;
  // Returns 0 in singular positions, where the axes that are not redundant_axes() cannot lead the tool in some
  // direction; with six axes or more the sign changes on passing through them.
  [[nodiscard]] double volume(const Joints& q) const noexcept;
  // Returns the first axis beyond its limits by more than `slack`, from 0; -1 if none. NaN and infinite values count as
  // beyond, and so do angles of endless axes beyond Axis::farthest.
  [[nodiscard]] int beyond_limits(const Joints& q, double slack = 1e-9) const noexcept;
  // As beyond_limits(), but an axis that is already beyond its limits at `from` counts only if it goes further: it may
  // come back.
  [[nodiscard]] int goes_beyond(const Joints& from, const Joints& to, double slack) const noexcept;
  // Returns joint positions that are evenly spread between the limits, a different one for each number.
  [[nodiscard]] Joints spread(int number) const noexcept;

 private:
  [[nodiscard]] static ChainFrame behind(const ChainFrame& before, const Link& link, const Joints& q) noexcept;

  Axes axes_;
  Pose home_;
  int count_;
  std::array<Link, kMostLinks> links_{};
  std::size_t link_count_ = 0;
  int world_joint_ = 0;
  std::optional<Delta> delta_;  // instead of links
  Pose tool_;                   // of a delta; a chain has it in `home_`
  Vec3 end_ = Vec3::Zero();     // end of the arm without a tool, in the tool's frame
};

// Returns the rotation by `angle` about the unit vector `axis`.
Mat3 turned(const Vec3& axis, double angle) noexcept;

}  // namespace indurop::robot
