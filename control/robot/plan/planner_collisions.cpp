// SPDX-License-Identifier: Apache-2.0
// Checks that a motion stays clear of the arm itself, of the tool and of zones, all along its path.

#include <algorithm>
#include <cmath>

#include "control/robot/plan/planner.h"

namespace indurop::robot {

namespace {

constexpr double kParts = 8;  // of a joint path: the longest step

}  // namespace

Fault Planner::begin_clear() noexcept {
  const bool joints = segment_.move == Move::Joint;
  if (!places_.clearance().known() || segment_.length <= 0) {
    if (!joints) {
      return time_it();
    }
    end_look();
    return {};
  }
  stage_ = Stage::Clear;
  clear_.begin(segment_.from, places_.tool());
  if (joints) {
    clear_way_ = segment_;
    if (clear_way_.together) {  // the follower ensures that it is the same path at any pace
      clear_way_.take_joint_timing({segment_.from, Joints::Zero(), Joints::Zero()}, all_joints_, 1);
    }
    walk_.begin(clear_way_.length, clear_way_.length / kParts);
  } else {
    walk_.begin(segment_.length, 2 * segment_.length / count_);
  }
  return {};
}

// Joint angles at a place; places that were checked before are already known.
bool Planner::joints_on_way(double place, const Joints& near, Joints& q) const noexcept {
  if (segment_.move == Move::Joint) {
    q = clear_way_.joints_at(place);
    return true;
  }
  const double sample = place / segment_.length * count_;
  const double nearest = std::round(sample);
  const Joints& known = samples_[static_cast<std::size_t>(std::clamp(nearest, 0.0, double{kMost}))];
  if (std::abs(sample - nearest) < 1e-9) {
    q = known;
    return true;
  }
  return places_.on(segment_, place, std::abs(sample - nearest) < 0.25 ? known : near, q) == Reach::Ok;
}

Fault Planner::clear(int& places) noexcept {
  const auto at = [this](double place, const Joints& near, Joints& q) { return joints_on_way(place, near, q); };
  for (; places > 0 && !walk_.done(); --places) {
    const CollisionCheck::Step step = walk_.step(clear_, at);
    if (step == CollisionCheck::Step::Lost) {
      return {ErrorCode::Singular};
    }
    if (step == CollisionCheck::Step::Touches) {
      const double length = segment_.move == Move::Joint ? clear_way_.length : segment_.length;
      if (segment_.chain != nullptr) {
        segment_.source = segment_.chain->source_at(walk_.place());
      }
      return {ErrorCode::Collision, 0, clear_.pair(), walk_.place() / length};
    }
  }
  if (!walk_.done()) {
    return {};
  }
  if (segment_.move != Move::Joint) {
    return time_it();
  }
  end_look();
  return {};
}

bool Planner::clear(const Segment& first, const Blend& blend, const Segment& second) noexcept {
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
  clear_.begin(start, places_.tool());
  ClearWalk walk;
  for (walk.begin(blend.length(), blend.length() / kParts); !walk.done();) {
    const CollisionCheck::Step step = walk.step(clear_, at);
    if (step == CollisionCheck::Step::Touches || step == CollisionCheck::Step::Lost) {
      return false;
    }
  }
  return true;
}

}  // namespace indurop::robot
