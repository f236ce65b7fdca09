// SPDX-License-Identifier: Apache-2.0
// Blending of a single axis' motion into the next one.

#include <algorithm>
#include <cmath>

#include "control/robot/axis/control.h"

namespace indurop::robot {

// Chooses the velocity with which the motion in progress blends into the next one. It must be possible to come to rest
// there.
void AxisControl::choose_passing() noexcept {
  if (!is_move(motion_owner_.service)) {
    return;
  }
  double passing = 0;
  if (queued_ > 0) {
    const Command& next = table_->command(queue_[0]);
    Order order;
    const double end = motion_.target();
    const bool works = resolve(next, end, order) == ErrorCode::Ok;
    const double own = motion_.speed();
    const double other = order.limits.velocity;
    const bool to_a_place = is_move(service_of(next)) || goes_on_from(service_of(next));
    const double way = to_a_place ? order.target - end : order.target;
    const bool ahead = way * (end - began_at_) > 0;
    if (works && ahead && (to_a_place || service_of(next) == AxisService::MoveVelocity)) {
      passing = next.buffer == BufferMode::BlendingLow        ? std::min(own, other)
                : next.buffer == BufferMode::BlendingPrevious ? own
                : next.buffer == BufferMode::BlendingNext     ? other
                : next.buffer == BufferMode::BlendingHigh     ? std::max(own, other)
                                                              : 0;
    }
    while (passing > 1e-6 && to_a_place && ramp({0, passing, 0}, 0, order.braking).distance > std::abs(way)) {
      passing *= 0.98;
    }
    passing = passing > 1e-6 ? passing : 0;
  }
  motion_.pass_with(passing);
}

}  // namespace indurop::robot
