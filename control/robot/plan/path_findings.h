// SPDX-License-Identifier: Apache-2.0
// What the check of a path's places finds out about it: how fast it may be followed in each part, what its joints leave
// for changes of speed, and where it is narrow.

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "control/robot/path/rates.h"
#include "control/robot/path/timing_search.h"
#include "control/robot/plan/draft.h"

namespace indurop::robot {

// A place where a path is narrow, and the joint angles there.
struct NarrowPlace {
  double place = 0;
  Joints joints = Joints::Zero();
};

class PathFindings {
 public:
  static constexpr int kMaxNoted = 768;

  PathFindings(const Places& places, Draft& draft) noexcept;

  // Begins with the draft's path. Real-time safe, like all functions of this class.
  void begin() noexcept;
  // Sets the tool's limits between two places of a chain, as parts of its length, and reduces the draft's to them.
  // Returns the lowest speed of them.
  double bound_tool(double from, double to) noexcept;
  // Bounds the speed, and its changes, in a part of the path that begins at `from` with the joints at `q`.
  void bound(const Rates& rates, double from, double length, const Joints& q) noexcept;
  // Bounds both everywhere.
  void bound_all(const LineLimits& most) noexcept;
  // Reduces the draft's speed to what these rates allow, and keeps them for leave_for_changes(). Rates that do not fit
  // are merged into the last ones, which can only make the path slower.
  void note(const Rates& rates) noexcept;
  // Records how far the arm is from a singular position, where `volume` is 0.
  void note_volume(double volume, double place, const Joints& q) noexcept;
  // Records whether an axis turns back so near to the end of its range that it may not be able to rest before it; `q`
  // are its joints at three consecutive places.
  void note_turn(const Joints* q) noexcept;
  // Reduces the draft's limits to what the noted rates leave for changes of speed.
  void leave_for_changes() noexcept;

  [[nodiscard]] const PathBounds& bounds() const noexcept { return bounds_; }
  // The place of the least volume, and that where a joint's limit makes the path slowest.
  [[nodiscard]] std::span<const NarrowPlace> narrow() const noexcept { return narrow_; }
  // Returns whether the path comes near a singular position.
  [[nodiscard]] bool nearly_singular() const noexcept;
  // Returns whether an axis turns back near the end of its range.
  [[nodiscard]] bool turns_at_end() const noexcept { return turns_at_end_; }

 private:
  const Places& places_;
  Draft& draft_;
  PathBounds bounds_;
  std::array<Rates, kMaxNoted> rates_{};
  std::size_t noted_ = 0;
  double usual_volume_ = 0;  // maximum volume of this arm
  double least_volume_ = 0;  // on the path
  double slowest_ = HUGE_VAL;
  bool turns_at_end_ = false;
  std::array<NarrowPlace, 2> narrow_;
};

}  // namespace indurop::robot
