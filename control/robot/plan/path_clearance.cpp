// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/path_clearance.h"

#include <algorithm>

namespace indurop::robot {

namespace {

constexpr double kClearParts = 8;  // of a joint path: the longest step
constexpr double kWaveParts = 8;   // of a wave: the longest step in which the middle shows its bend

}  // namespace

void PathClearance::begin() noexcept {
  const Segment& s = draft_.segment;
  if (!places_.clearance().known() || s.length <= 0) {
    walk_.begin(0, 0);
    return;
  }
  bodies_.begin(s.from, places_.tool());
  if (s.move != Move::Joint) {
    const double widest = 2 * s.length / survey_.count();
    walk_.begin(s.length, s.wave.on() ? std::min(widest, s.wave.length / kWaveParts / s.pace()) : widest);
    return;
  }
  path_ = s;
  if (path_.together) {  // the follower ensures that it is the same path at any pace
    path_.take_joint_timing({s.from, Joints::Zero(), Joints::Zero()}, joints_, 1);
  }
  walk_.begin(path_.length, path_.length / kClearParts);
}

// Joint angles at a place; places that were checked before are already known.
bool PathClearance::joints_at(double place, const Joints& near, Joints& q) const noexcept {
  if (draft_.segment.move == Move::Joint) {
    q = path_.joints_at(place);
    return true;
  }
  const bool known = survey_.find(place, near, q);
  return (known && !draft_.segment.wave.on()) || places_.on(draft_.segment, place, q, q) == Reach::Ok;
}

Fault PathClearance::check(int& places) noexcept {
  const auto at = [this](double place, const Joints& near, Joints& q) { return joints_at(place, near, q); };
  for (; places > 0 && !walk_.done(); --places) {
    const JointPath* const path = draft_.segment.joint_path;
    const CollisionCheck::Step step = path == nullptr
                                          ? walk_.step(bodies_, at)
                                          : walk_.step_along(
                                                bodies_, [path](double place) { return path->at(place); },
                                                [path](double from, double to) { return path->travel(from, to); });
    if (step == CollisionCheck::Step::Lost) {
      return {ErrorCode::Singular};
    }
    if (step == CollisionCheck::Step::Touches) {
      const double length = draft_.segment.move == Move::Joint ? path_.length : draft_.segment.length;
      draft_.blame(walk_.place());
      return {ErrorCode::Collision, 0, bodies_.pair(), walk_.place() / length};
    }
  }
  return {};
}

bool PathClearance::is_clear(const Segment& first, const Blend& blend, const Segment& second) noexcept {
  if (!places_.clearance().known()) {
    return true;
  }
  Joints start = first.to;
  if (places_.on(first, blend, second, 0, first.to, start) != Reach::Ok) {
    return false;
  }
  const auto at = [&](double place, const Joints& near, Joints& q) {
    return places_.on(first, blend, second, place, near, q) == Reach::Ok;
  };
  bodies_.begin(start, places_.tool());
  ClearWalk walk;
  for (walk.begin(blend.length(), blend.length() / kClearParts); !walk.done();) {
    const CollisionCheck::Step step = walk.step(bodies_, at);
    if (step == CollisionCheck::Step::Touches || step == CollisionCheck::Step::Lost) {
      return false;
    }
  }
  return true;
}

}  // namespace indurop::robot
