// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/wave_check.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kLeastLook = 1e-4;  // m, to the side
// Parts of the limits for the wave: at constant speed, for a change of the speed, and for the jerk while it changes.
constexpr double kSpeed = 0.8, kSteady = 0.6, kChanging = 0.2;

}  // namespace

void WaveCheck::begin() noexcept {
  next_ = draft_.wave.on() ? 1 : -1;
  of_speed_ = 1 / draft_.tool.velocity;
  of_acceleration_ = 1 / draft_.tool.acceleration;
  of_jerk_ = 1 / draft_.tool.jerk;
}

Fault WaveCheck::check(int& places) noexcept {
  for (; places > 0 && next_ < survey_.count(); places -= 2, ++next_) {
    if (const Fault fault = check_next(); !fault.ok()) {
      return fault;
    }
  }
  if (next_ >= survey_.count()) {
    finish();
    next_ = -1;
  }
  return {};
}

Fault WaveCheck::check_next() noexcept {
  const Segment& s = draft_.segment;
  const double place = s.length * next_ / survey_.count();
  const Joints& here = survey_.samples()[next_];
  const Pose middle = s.pose_at(place);
  const PathWay way = s.way_at(place);
  const Vec3 side = draft_.wave.side(way.moving, middle.orientation);
  draft_.blame(place);
  draft_.work.add_on_path(2);
  if (side.isZero()) {
    return {ErrorCode::Wave};
  }
  const double far = std::max(draft_.wave.width / 2 * Wave::swell(way.gone, way.whole, draft_.wave.length), kLeastLook);
  Joints moved = Joints::Zero();
  for (const double sign : {1.0, -1.0}) {
    const Pose there{middle.position + sign * far * side, middle.orientation};
    const auto found = places_.inverse().nearest(there, places_.held_at(s, place, here));
    if (found.reach != Reach::Ok) {
      return {code_of(found.reach)};
    }
    if (places_.box().left(middle.position, there.position)) {
      return {ErrorCode::Workspace};
    }
    moved = moved.cwiseMax((found.solution.q - here).cwiseAbs());
  }
  const Joints rates = moved / far;
  of_speed_ = std::max(of_speed_, rates.cwiseQuotient(draft_.joints.velocity).maxCoeff());
  of_acceleration_ = std::max(of_acceleration_, rates.cwiseQuotient(draft_.joints.acceleration).maxCoeff());
  of_jerk_ = std::max(of_jerk_, rates.cwiseQuotient(draft_.joints.jerk).maxCoeff());
  return {};
}

// The wave needs speed and acceleration of the path times its slope, and what its bends need of the speed alone.
LineLimits WaveCheck::bounded(const LineLimits& path) const noexcept {
  const Wave::Steepness wave = draft_.wave.steepness();
  const double pace = draft_.segment.pace();
  const double speed =
      std::min({pace * path.velocity, kSpeed / (wave.slope * of_speed_),
                std::sqrt(kSteady / (wave.bend * of_acceleration_)), std::cbrt(kSteady / (wave.twist * of_jerk_))});
  const double acceleration =
      std::min((1 - kSteady) / (wave.slope * of_acceleration_), kChanging / (3 * wave.bend * speed * of_jerk_));
  const double jerk = kChanging / (wave.slope * of_jerk_);
  return {std::min(path.velocity, speed / pace), std::min(path.acceleration, acceleration / pace),
          std::min(path.jerk, jerk / pace)};
}

void WaveCheck::finish() noexcept {
  Segment& s = draft_.segment;
  s.wave = draft_.wave;
  // Only some places may need the path to be as slow as its limits for a constant speed.
  s.most = bounded(s.most);
  s.limits = bounded(s.limits);
  survey_.findings().bound_all(s.most);
}

}  // namespace indurop::robot
