// SPDX-License-Identifier: Apache-2.0
// Finds the timing of a path that is as fast as the joints allow at each place: speed, acceleration and jerk of every
// joint and of the tool. It chooses the positions of the knots and determines what limits the motion there.

#pragma once

#include <array>

#include "control/robot/path/segment.h"
#include "control/robot/path/timing.h"
#include "control/robot/path/timing_barrier.h"

namespace indurop::robot {

// The data known of a path before the search for a timing: bounds of its speed in equal parts of its length.
struct PathBounds {
  static constexpr int kParts = 512;
  std::array<double, kParts> speed{};
  std::array<double, kParts> acceleration{};
};

class TimingSearch {
 public:
  TimingSearch(const Places& places, const JointLimits& joints) noexcept : places_(places), joints_(joints) {}

  void begin(const Segment& segment, const PathBounds& bounds) noexcept;
  // Records that the timing takes too little time around `time`: it needs `factor` times as long.
  void note(double time, double factor) noexcept;
  // Searches again, with the limits also kept half way between the knots; the next time, slower where note() recorded
  // that it is too fast.
  void refine() noexcept;
  // When done: returns whether there is no timing only because the places at which limits are kept are too far apart.
  [[nodiscard]] bool too_coarse() const noexcept { return too_coarse_; }
  // Does a part of the work; returns how much that was, as the number of places whose inverse kinematics take as long.
  // Real-time safe.
  int work() noexcept;
  [[nodiscard]] bool done() const noexcept { return stage_ == Stage::Done; }
  // Returns whether the next part of the work asks for places on the path.
  [[nodiscard]] bool looks() const noexcept { return stage_ == Stage::Look; }
  // The result when done; not known() if none was found. It keeps the limits at its knots, after refine() also half way
  // between. If refining finds none, it is the earlier one.
  [[nodiscard]] const PathTiming& timing() const noexcept { return timing_; }

 private:
  enum class Stage { Look, Search, Done };

  using PartTimes = std::array<double, PathBounds::kParts + 1>;
  bool guess(const PathBounds& bounds) noexcept;
  static void count_calm_less(const PartTimes& square, PartTimes& time) noexcept;
  void smooth_ends() noexcept;
  bool look(int index) noexcept;
  [[nodiscard]] PathTiming::Value place_at(int index) const noexcept;

  const Places& places_;
  const JointLimits& joints_;
  Segment segment_;
  PathTiming timing_;
  TimingBarrier barrier_;
  Stage stage_ = Stage::Done;
  int count_ = 0;
  int per_knot_ = 1;
  bool too_coarse_ = false;
  // The factors by which the limits of a piece are reduced, and by which they have to be reduced further.
  std::array<double, PathTiming::kMaxPieces> slower_{}, noted_{};
  int next_ = 0;
  Joints near_ = Joints::Zero();
  std::array<double, PathTiming::kMaxPieces + 5> shape_{};
};

}  // namespace indurop::robot
