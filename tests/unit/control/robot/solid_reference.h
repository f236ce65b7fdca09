// SPDX-License-Identifier: Apache-2.0
// A second opinion on what touches what, written another way: the distance of two bodies by going to and fro between
// their nearest points, and arms whose links are placed one behind the other, as URDF has them.

#pragma once

#include <random>
#include <string>
#include <vector>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

struct ReferenceSolid {
  enum class Kind { Box, Cylinder, Ball } kind = Kind::Box;
  Vec3 size = Vec3::Zero();  // edges; radius and length; radius
  Vec3 origin = Vec3::Zero(), rpy = Vec3::Zero();

  // The point of it that is nearest to one, in its own frame.
  [[nodiscard]] Vec3 nearest(const Vec3& point) const;
  [[nodiscard]] std::string xml() const;
};

// One that stands somewhere.
struct ReferencePlace {
  const ReferenceSolid* solid = nullptr;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
};

// m; never less than what it is, and hardly more. 0 where they meet.
double reference_distance(const ReferencePlace& a, const ReferencePlace& b);

struct ReferenceArm {
  struct Joint {
    Vec3 origin = Vec3::Zero(), rpy = Vec3::Zero(), axis = Vec3::UnitZ();
    bool slides = false;
    double lower = -3, upper = 3;
  };
  std::vector<Joint> joints;
  std::vector<ReferenceSolid> solids;  // of the base and of the links behind each joint; one each
  Vec3 tool = Vec3::Zero();
  // The axes of a positioner next to the arm, and the bodies behind each; the last one is the workpiece.
  std::vector<Joint> table{};
  std::vector<ReferenceSolid> on_table{};

  // The arm of the robot cell, about.
  static ReferenceArm usual();
  // The same with a table in front of it that turns, and also tilts if it has two axes.
  static ReferenceArm with_table(int axes);
  static ReferenceArm any(std::mt19937& random);
  [[nodiscard]] std::string urdf() const;
  // The axes of the table come after those of the arm.
  [[nodiscard]] std::vector<ReferencePlace> places(const Joints& q) const;
  // The workpiece with the table at zero.
  [[nodiscard]] Eigen::Isometry3d workpiece() const;
  // Of bodies that more than one joint is between and that do not touch with all joints at zero: m, at least `least`
  // of those that are in question.
  [[nodiscard]] double clearance(const Joints& q, const std::vector<ReferencePlace>& zones = {}) const;
};

ReferenceSolid any_solid(std::mt19937& random, double most);

}  // namespace indurop::robot
