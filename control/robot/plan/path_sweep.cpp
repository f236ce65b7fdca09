// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/path_sweep.h"

#include <algorithm>

namespace indurop::robot {

namespace {

constexpr double kLongestPart = 1.0 / 32;  // of a path: the longest step, in which the middle shows how it bends
constexpr double kPartsOfWave = 8;         // the same of a wave

// Adds the bodies along a path, step by step: a body that moves by D from one end of a step to the other is never
// farther from one of them than D / 2. The first steps are short, so that a motion away from another robot needs no
// cells on its side.
class Sweeping {
 public:
  Sweeping(const ArmCells& arm, int tool, const Joints& from, SpaceCells& cells) noexcept
      : arm_(arm), tool_(tool), at_(from), cells_(cells), most_(arm.grid().edge() * kFirstStep) {
    stamp(most_);
  }
  [[nodiscard]] const Joints& at() const noexcept { return at_; }
  CollisionCheck::Step next(const Joints& to, const Joints& moved) noexcept {
    if (arm_.most_moved(moved, tool_) > most_) {
      return CollisionCheck::Step::Shorter;
    }
    at_ = to;
    most_ = std::min(kGrowth * most_, arm_.grid().edge());
    stamp(most_);
    return CollisionCheck::Step::Clear;
  }

 private:
  static constexpr double kFirstStep = 1.0 / 16;  // part of a cell's edge
  static constexpr double kGrowth = 1.5;          // of each step

  // `longest`: of the steps before and after this place.
  void stamp(double longest) noexcept {
    arm_.add(at_, Joints::Zero(), tool_, longest / 2 + arm_.grid().slack(), cells_);
  }

  const ArmCells& arm_;
  int tool_;
  Joints at_;
  SpaceCells& cells_;
  double most_;  // m, that a body may move in the next step
};

template <class Step>
void walk_along(double length, double widest, const std::atomic<bool>& dropped, SpaceCells& cells, const Step& step) {
  ClearWalk walk;
  for (walk.begin(length, widest); !walk.done() && !dropped.load(std::memory_order_relaxed);) {
    if (step(walk) == CollisionCheck::Step::Lost) {
      cells.fill(~std::uint64_t{0});  // it was found when the path was planned, so this should not happen
      return;
    }
  }
}

}  // namespace

void PathSweep::sweep(const Segment& segment, const std::atomic<bool>& dropped, SpaceCells& cells) noexcept {
  cells.fill(0);
  const ArmCells arm(places_.clearance(), *grid_);
  Sweeping sweeping(arm, places_.tool(), segment.from, cells);
  if (segment.length <= 0) {
    return;
  }
  if (const JointPath* const path = segment.joint_path; path != nullptr) {
    walk_along(segment.length, segment.length * kLongestPart, dropped, cells, [&](ClearWalk& walk) {
      return walk.step_along(
          sweeping, [path](double place) { return path->at(place); },
          [path](double from, double to) { return path->travel(from, to); });
    });
    return;
  }
  path_ = segment;
  if (segment.move == Move::Joint && path_.together) {  // the follower ensures that it is the same path at any pace
    path_.take_joint_timing({segment.from, Joints::Zero(), Joints::Zero()}, joints_, 1);
  }
  double widest = path_.length * kLongestPart;
  widest = path_.wave.on() ? std::min(widest, path_.wave.length / kPartsOfWave / path_.pace()) : widest;
  walk_along(path_.length, widest, dropped, cells, [&](ClearWalk& walk) {
    return walk.step(sweeping, [&](double place, const Joints& near, Joints& q) {
      return places_.on(path_, place, near, q) == Reach::Ok;
    });
  });
}

void PathSweep::add(const Segment& before, const Blend& blend, const Segment& segment, const std::atomic<bool>& dropped,
                    SpaceCells& cells) noexcept {
  Joints start = before.to;
  if (places_.on(before, blend, segment, 0, before.to, start) != Reach::Ok) {
    cells.fill(~std::uint64_t{0});
    return;
  }
  const ArmCells arm(places_.clearance(), *grid_);
  Sweeping sweeping(arm, places_.tool(), start, cells);
  walk_along(blend.length(), blend.length() * kLongestPart, dropped, cells, [&](ClearWalk& walk) {
    return walk.step(sweeping, [&](double place, const Joints& near, Joints& q) {
      return places_.on(before, blend, segment, place, near, q) == Reach::Ok;
    });
  });
}

}  // namespace indurop::robot
