// SPDX-License-Identifier: Apache-2.0
// Random scenes of an arm among obstacles, and what FCL says about them: a second opinion on whether the arm is clear.

#pragma once

#include <fcl/narrowphase/collision_object.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "solid_reference.h"

namespace indurop::robot {

class Scene {
 public:
  static constexpr double kMargin = 0.005;  // m, Settings::clearance

  // The arm of the cell, about, among 5 to 12 zones; start and goal are clear.
  explicit Scene(unsigned seed);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  // m between the nearest bodies that must stay clear, `most` if that is less. FCL computes it.
  [[nodiscard]] double room(const Joints& q, double most = 1) const;
  // Whether the straight way between joint values is clear, at many places.
  [[nodiscard]] bool is_straight_clear() const;
  [[nodiscard]] int axes() const { return static_cast<int>(arm_.joints.size()); }
  [[nodiscard]] const ReferenceArm& arm() const { return arm_; }
  // The zones and two points, S and G, as lines of a job.
  [[nodiscard]] const std::string& job() const { return job_; }

  Joints start = Joints::Zero(), goal = Joints::Zero();

 private:
  using Object = std::unique_ptr<fcl::CollisionObjectd>;
  void add_zone(std::mt19937& random, int number);
  [[nodiscard]] Joints anywhere(std::mt19937& random) const;
  [[nodiscard]] Joints clear_place(std::mt19937& random) const;
  [[nodiscard]] static double distance(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b, double most);
  void place(const Joints& q) const;

  ReferenceArm arm_ = ReferenceArm::usual();
  std::vector<Object> links_, zones_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;  // of links
  std::string job_;
};

}  // namespace indurop::robot
