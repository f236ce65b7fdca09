// SPDX-License-Identifier: Apache-2.0
// An arm as geometry and limits: where its tool is, and how it moves when the axes do. Axes are kept as lines in the
// base's frame with all joints at zero (product of exponentials), which any URDF can be brought to.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>

#include "robot/delta.h"

namespace indurop::robot {

enum class AxisKind : std::uint8_t { Turning, Sliding };

struct Axis {
  std::string name;
  Vec3 direction = Vec3::UnitZ();  // unit vector
  Vec3 point = Vec3::Zero();       // on the axis
  double lower = -kPi;             // rad, or m of sliding ones; so everywhere
  double upper = kPi;
  bool endless = false;  // turns on and on; lower and upper do not count
  AxisKind kind = AxisKind::Turning;
  [[nodiscard]] bool slides() const noexcept { return kind == AxisKind::Sliding; }
};

// A joint of the chain: an axis itself, or what a linkage moves with it.
struct Link {
  Vec3 direction = Vec3::UnitZ();
  Vec3 point = Vec3::Zero();
  AxisKind kind = AxisKind::Turning;
  int axis = 0;
  double ratio = 1;  // of the axis' motion
};

// What a part of the chain has turned and moved to, seen from where it is with all joints at zero.
struct ChainFrame {
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
};

// What the axes can do at most.
struct JointLimits {
  Joints velocity = Joints::Constant(1);      // rad/s
  Joints acceleration = Joints::Constant(4);  // rad/s^2
  Joints jerk = Joints::Constant(40);         // rad/s^3
};

// Motions that are to take only part of the accelerations and jerks.
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
  // The chain from base to tool is made of `links`, kMostLinks at most.
  Arm(Axes axes, const Pose& home, int count, const Link* links, std::size_t link_count) noexcept;

  // Three arms of a delta, and with four axes the turn of its tool.
  Arm(Axes axes, const Delta& delta, int count) noexcept;

  // The same arm with a tool at its end: where that is when seen from the end.
  [[nodiscard]] Arm with_tool(const Pose& tool) const noexcept;

  [[nodiscard]] int count() const noexcept { return count_; }
  [[nodiscard]] const Axis& axis(int index) const noexcept { return axes_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const Axes& axes() const noexcept { return axes_; }
  [[nodiscard]] const Pose& home() const noexcept { return home_; }
  // Six axes one behind the other, all of which turn.
  [[nodiscard]] bool turns_six() const noexcept;
  // Real-time safe, as all the rest.
  [[nodiscard]] Pose forward(const Joints& q) const noexcept;
  // Where the arm itself ends when the tool is there.
  [[nodiscard]] Vec3 end_of(const Pose& tool) const noexcept { return tool.position + tool.orientation * end_; }
  // Of what is behind each joint of the chain; the first one is the base's.
  void frames(const Joints& q, ChainFrames& frames) const noexcept;
  // Joints of the chain; 0 of a delta, which is none.
  [[nodiscard]] int chain_length() const noexcept { return static_cast<int>(link_count_); }
  [[nodiscard]] const Link& link(int index) const noexcept { return links_[static_cast<std::size_t>(index)]; }
  // Of the tool's point, in the base's frame.
  [[nodiscard]] Jacobian jacobian(const Joints& q) const noexcept {
    Pose tool;
    return jacobian(q, tool);
  }
  // And where the tool is.
  [[nodiscard]] Jacobian jacobian(const Joints& q, Pose& tool) const noexcept;
  // 0 in singular positions; of six axes with another sign on their other side.
  [[nodiscard]] double volume(const Joints& q) const noexcept;
  // First axis beyond its limits by more than `slack`, from 0; -1 if none. Values that are no number are beyond.
  [[nodiscard]] int beyond_limits(const Joints& q, double slack = 1e-9) const noexcept;
  // Likewise, further than at `from`: what stands beyond its limits may come back.
  [[nodiscard]] int goes_beyond(const Joints& from, const Joints& to, double slack) const noexcept;
  // Places that are evenly spread between the limits, one of each number.
  [[nodiscard]] Joints spread(int number) const noexcept;

 private:
  Axes axes_;
  Pose home_;
  int count_;
  std::array<Link, kMostLinks> links_{};
  std::size_t link_count_ = 0;
  std::optional<Delta> delta_;  // instead of links
  Pose tool_;                   // of a delta; of links it is in `home_`
  Vec3 end_ = Vec3::Zero();     // of the arm without a tool, seen from the tool
};

// The rotation by `angle` about the unit vector `axis`.
Mat3 turned(const Vec3& axis, double angle) noexcept;

}  // namespace indurop::robot
