// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/blending.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "control/robot/plan/effort_look.h"

namespace indurop::robot {

namespace {

constexpr int kBlendPlaces = 64;  // its jerk is greatest at its ends, where differences are the mean of three parts

// Returns whether rounding the corner is at least as fast as stopping there.
bool faster(const Segment& first, const Blend& blend, const Segment& second) noexcept {
  return blend.limits.velocity > 0 &&
         duration(first, blend, second) < Profile::to_position({}, first.length, 0, first.limits).duration() +
                                              Profile::to_position({}, second.length, 0, second.limits).duration();
}

// The velocity and rotation of the tool at full speed, in the base's frame.
struct Heading {
  Vec3 moving, turning;
};

// The heading of a line or circle at its beginning or end.
Heading heading(const Segment& s, bool at_end) noexcept {
  const Vec3 turning = s.start.orientation * s.turn / s.length;
  if (s.move != Move::Circle) {
    return {(s.end.position - s.start.position) / s.length, turning};
  }
  const double angle = at_end ? s.angle : 0;
  return {(std::cos(angle) * s.radius_y - std::sin(angle) * s.radius_x) * (s.angle / s.length), turning};
}

}  // namespace

double duration(const Segment& first, const Blend& blend, const Segment& second) noexcept {
  const double speed = blend.limits.velocity;
  const double to = Profile::to_position({}, first.length - blend.zone, speed, first.limits).duration();
  const double from = Profile::to_position({0, speed, 0}, second.length - blend.zone, 0, second.limits).duration();
  return to + blend.length() / speed + from;
}

// The tool's speed at the corner, at full speed, determines the length of the zone.
double Blending::zone(const Segment& first, const Segment& second) const noexcept {
  const Jacobian j = places_.arm().jacobian(first.to);
  const auto pace = [&](const Segment& s) {
    return s.move == Move::Joint ? (j.topRows<3>() * ((s.to - s.from) / s.length)).norm() : s.pace();
  };
  const double fastest = std::max(pace(first), pace(second));
  const double half = std::min(first.length, second.length) / 2;
  return std::min(half, shared(first.zone, fastest));
}

// The limits that the two paths and the tool set for the speed in the transition.
LineLimits Blending::limits(const Segment& first, const Blend& blend, const Segment& second) const noexcept {
  LineLimits most{std::min(first.limits.velocity, second.limits.velocity),
                  std::min(first.limits.acceleration, second.limits.acceleration),
                  std::min(first.limits.jerk, second.limits.jerk)};
  if (first.move != Move::Joint && second.move != Move::Joint) {
    // A change between the two, at full speed, is this many times as fast in the middle as on average.
    constexpr double kMiddle = 5.0 / 3;
    const ToolLimits tool = gentler(tool_, std::min(first.acceleration, second.acceleration));
    const Heading before = heading(first, true);
    const Heading after = heading(second, false);
    const double bend = kMiddle * (after.moving - before.moving).norm() / blend.length();
    const double turn = kMiddle * (after.turning - before.turning).norm() / blend.length();
    most.velocity = std::min({most.velocity, std::sqrt(shared(tool.acceleration / 2, bend)),
                              std::sqrt(shared(tool.turn_acceleration / 2, turn))});
  }
  return most;
}

Blend Blending::blend(const Segment& first, const Segment& second) noexcept {
  Blend result;
  if (first.zone <= 0 || first.chain != nullptr || second.chain != nullptr || second.joint_path != nullptr ||
      first.length <= 0 || second.length <= 0) {
    return result;
  }
  result.zone = zone(first, second);
  std::array<Joints, kBlendPlaces + 1> places;
  const double spacing = result.length() / kBlendPlaces;
  Joints near = first.to;
  TipSpeed tip(places_.arm());
  for (int i = 0; i <= kBlendPlaces; ++i) {
    if (places_.on(first, result, second, spacing * i, near, near) != Reach::Ok ||
        places_.arm().beyond_limits(near) >= 0 || places_.box().outside(places_.arm().forward(near).position) > 0) {
      return {};
    }
    places[static_cast<std::size_t>(i)] = near;
    i == 0 ? tip.begin(near) : tip.note(near);
  }
  result.tip_speed = std::max({tip.farthest() / spacing, first.tip_speed, second.tip_speed});
  const JointLimits joints = gentler(joints_, std::min(first.acceleration, second.acceleration));
  result.limits = limits_along(places.data(), kBlendPlaces, spacing, joints, limits(first, result, second));
  if (places_.dynamics() != nullptr &&
      !slow_down(*places_.dynamics(), places.data(), kBlendPlaces, spacing, result.limits)) {
    return {};
  }
  return faster(first, result, second) && clearance_.is_clear(first, result, second) ? result : Blend{};
}

}  // namespace indurop::robot
