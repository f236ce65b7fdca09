// SPDX-License-Identifier: Apache-2.0
// Searches for a way around obstacles: two trees of clear places of the arm, from the start and from the target, grow
// towards random places and towards each other until they meet (RRT-Connect, Kuffner and LaValle 2000). The way found
// is shortened, and its corners are rounded as far as they stay clear. The same seed finds the same way.

#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "control/robot/collision/collision_check.h"
#include "control/robot/kinematics/errors.h"
#include "control/robot/path/joint_path.h"
#include "control/robot/path/segment.h"

namespace indurop::robot {

class FreeSearch {
 public:
  // Places to grow the trees towards, after which there is no way.
  static constexpr int kMostTries = 5000;

  // All are borrowed; nothing else uses the bodies during a search.
  FreeSearch(const Places& places, CollisionCheck& bodies) noexcept  // NOLINT(cert-msc51-cpp): begin() sets the seed
      : places_(places), bodies_(bodies) {}
  FreeSearch(const FreeSearch&) = delete;
  FreeSearch& operator=(const FreeSearch&) = delete;

  // Begins to search from `from` to any of these solutions, of which the first one is preferred. `velocity`: of the
  // joints, m/s or rad/s. The path is valid when done(). Allocates, like work(). Errors: Collision.
  Fault begin(const Joints& from, const Solutions& goals, const Joints& velocity, std::uint32_t seed, JointPath& path);
  // Does up to `places` more of the work, in places of a path, and subtracts what it did. Errors: NoWay.
  Fault work(int& places);
  [[nodiscard]] bool done() const noexcept { return stage_ == Stage::Done; }
  // Tries that the search has taken.
  [[nodiscard]] int tries() const noexcept { return tries_; }

 private:
  enum class Stage { Search, Shorten, Round, Done };
  struct Node {
    Joints q = Joints::Zero();
    int before = -1;  // node nearer to the root of its tree; -1: it is the root
  };
  using Tree = std::vector<Node>;

  void add_goal();
  // Grows one tree towards a random place, and the other one to where that led. Returns whether they meet.
  bool grow();
  void join(int start_node, int goal_node);
  void shorten();
  bool replace(std::size_t first, double first_part, std::size_t last, double last_part);
  Fault round();
  [[nodiscard]] bool is_clear(int corner) noexcept;

  // Goes straight to a place as far as that is clear. Returns which part of it is.
  double go(const Joints& from, const Joints& to) noexcept;
  // Adds what is clear of a step from a node towards a place. Returns the new node, -1: nothing is; `there`: it reached
  // the place.
  int extend(Tree& tree, int node, const Joints& to, bool& there);
  [[nodiscard]] int nearest(const Tree& tree, const Joints& q) const noexcept;
  [[nodiscard]] double distance(const Joints& a, const Joints& b) const noexcept;
  // At least 0 and below 1.
  double chance() noexcept;
  [[nodiscard]] Joints anywhere() noexcept;
  [[nodiscard]] Fault no_way() const noexcept;

  const Places& places_;
  CollisionCheck& bodies_;
  JointPath* path_ = nullptr;
  Stage stage_ = Stage::Done;
  std::mt19937 random_;
  Joints from_ = Joints::Zero(), velocity_ = Joints::Ones();
  Solutions goals_;
  int next_goal_ = 0;
  int tries_ = 0, cuts_ = 0;
  Tree trees_[2];  // from the start, from the goals
  std::vector<Joints> points_;
  std::vector<int> hits_;  // how often each pair of bodies was in the way
};

}  // namespace indurop::robot
