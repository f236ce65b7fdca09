// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/posture_walk.h"

namespace indurop::robot {

// In as many steps as it takes to stay in the same posture: next to a singular position joints turn far over a short
// distance, and beyond it the nearest solution is often another posture. So is that behind a joint's limit, which may
// be near: what looks like it is divided further.
Fault walk_in_posture(const Places& places, Draft& draft, double from, const Joints& start, double to,
                      Joints& q) noexcept {
  constexpr double kJump = radians(60);  // between neighbouring places: the arm would have to flip over
  constexpr double kSure = radians(30);
  constexpr double kAtLimit = radians(1);
  if (draft.segment.joint_path != nullptr) {
    q = draft.segment.joint_path->at(to);  // in any posture
    return {};
  }
  const Arm& arm = places.arm();
  const double finest = 1e-6 * draft.segment.length;
  const double finest_turn = 1e-9 * draft.segment.length;
  Joints before = start;
  double side = arm.volume(start);
  for (double width = to - from; from < to;) {
    const double place = from + 1.001 * width >= to ? to : from + width;
    draft.work.add_on_path(1);
    if (!draft.work.may_refuse()) {
      return {ErrorCode::Singular};
    }
    if (const Reach reach = places.on(draft.segment, place, before, q); reach != Reach::Ok) {
      return {code_of(reach)};
    }
    Eigen::Index axis = 0;
    const double jump = (q - before).cwiseAbs().maxCoeff(&axis);
    const double other = arm.volume(q);
    const bool turns = jump > kSure && (width > finest || jump < kJump);
    if (width > (turns ? finest_turn : finest) && (turns || side * other < 0)) {
      width /= 2;
      continue;
    }
    if (jump > kSure) {
      // The continuation in this posture may be beyond a limit.
      const int ended = arm.beyond_limits(before, -kAtLimit);
      return ended >= 0 ? Fault{ErrorCode::JointLimit, ended + 1}
                        : Fault{ErrorCode::Singular, static_cast<int>(axis) + 1};
    }
    before = q;
    side = other;
    from = place;
    width *= 2;
  }
  return {};
}

}  // namespace indurop::robot
