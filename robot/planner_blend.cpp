// SPDX-License-Identifier: Apache-2.0
// How one path goes over into the next.

#include <algorithm>
#include <array>
#include <cmath>

#include "robot/planner.h"

namespace indurop::robot {

namespace {

constexpr int kBlendPlaces = 16;

// Whether a sharp corner is not so slow to go round that stopping there would be faster.
bool faster(const Segment& first, const Blend& blend, const Segment& second) noexcept {
  const double speed = blend.limits.velocity;
  if (!(speed > 0)) {
    return false;
  }
  const double to = Profile::to_position({}, first.length - blend.zone, speed, first.limits).duration();
  const double from = Profile::to_position({0, speed, 0}, second.length - blend.zone, 0, second.limits).duration();
  return to + blend.length() / speed + from < Profile::to_position({}, first.length, 0, first.limits).duration() +
                                                  Profile::to_position({}, second.length, 0, second.limits).duration();
}

}  // namespace

Blend Planner::blend(const Segment& first, const Segment& second) const noexcept {
  Blend result;
  if (first.zone <= 0 || first.length <= 0 || second.length <= 0) {
    return result;
  }
  // How fast the tool is at the corner, at full speed, says how long the zone is.
  const Jacobian j = places_.arm().jacobian(first.to);
  const auto pace = [&](const Segment& s) {
    return s.move == Move::Joint ? (j.topRows<3>() * ((s.to - s.from) / s.length)).norm() : s.pace();
  };
  const double fastest = std::max(pace(first), pace(second));
  const double half = std::min(first.length, second.length) / 2;
  result.zone = std::min(half, shared(first.zone, fastest));
  std::array<Joints, kBlendPlaces + 1> places;
  const double spacing = result.length() / kBlendPlaces;
  Joints near = first.to;
  for (int i = 0; i <= kBlendPlaces; ++i) {
    if (places_.on(first, result, second, spacing * i, near, near) != Reach::Ok ||
        places_.arm().beyond_limits(near) >= 0) {
      return {};
    }
    places[static_cast<std::size_t>(i)] = near;
  }
  LineLimits most{std::min(first.limits.velocity, second.limits.velocity),
                  std::min(first.limits.acceleration, second.limits.acceleration),
                  std::min(first.limits.jerk, second.limits.jerk)};
  if (first.move != Move::Joint && second.move != Move::Joint) {
    // The direction of the tool changes by at most this in one second at full speed.
    const double change = first.pace() + second.pace();
    const double bend = 1.5 * change / result.length();
    most.velocity = std::min(most.velocity, std::sqrt(shared(tool_.acceleration / 2, bend)));
  }
  result.limits = limits_along(places.data(), kBlendPlaces, spacing, joints_, most);
  return faster(first, result, second) ? result : Blend{};
}

}  // namespace indurop::robot
