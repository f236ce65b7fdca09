// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/chain.h"

#include <algorithm>
#include <cmath>

#include "control/robot/path/rates.h"

namespace indurop::robot {

namespace {

// The weight at distance `u`, from -1 to 1, its derivative, its integral from -1 on and the integral of that.
double weight(double u) noexcept {
  const double rest = 1 - u * u;
  return 15.0 / 16 * rest * rest;
}

double weight_change(double u) noexcept {
  return -15.0 / 4 * u * (1 - u * u);
}

double sum(double u) noexcept {
  return 0.5 + 15.0 / 16 * u * (1 - u * u * (2.0 / 3 - u * u / 5));
}

double sum_of_sums(double u) noexcept {
  const double square = u * u;
  return 5.0 / 32 + u / 2 + 15.0 / 32 * square * (1 - square * (1.0 / 3 - square / 15));
}

// Grows like x at first and reaches 1.
double narrowed(double x) noexcept {
  if (x >= 2) {
    return 1;
  }
  const double y = x / 2;
  return x - 2 * y * y * y * y * (y * (y - 3) + 2.5);
}

}  // namespace

void Chain::begin(const Pose& start, const ToolLimits& tool) noexcept {
  tool_ = tool;
  count_ = 0;
  crowded_ = false;
  way_ = at_speed_ = at_[0] = 0;
  poses_[0] = start;
}

bool Chain::add(const Line& line) noexcept {
  const Pose& from = poses_[at(count_)];
  const Vec3 move = line.end.position - from.position;
  const Vec3 turn = rotation_between(from.orientation, line.end.orientation);
  const double way = move.norm();
  const double length = std::max(way / tool_.velocity, turn.norm() / tool_.turn_velocity);
  if (length <= 1e-9) {
    return false;
  }
  const std::size_t i = at(count_);
  moving_[i] = move / length;
  turning_[i] = from.orientation * turn / length;
  turns_[i] = turn;
  speeds_[i] = line.tool_speed > 0 ? std::min(1.0, shared(line.tool_speed, way / length)) : line.speed;
  sources_[i] = line.source;
  zones_[i] = line.zone;
  crowded_ = crowded_ || (count_ > 0 && way < zones_[i - 1] + line.zone);
  way_ += way;
  at_speed_ += length / speeds_[i];
  ++count_;
  at_[at(count_)] = at_[i] + length;
  poses_[at(count_)] = line.end;
  return true;
}

void Chain::finish() noexcept {
  constexpr int kWithin = 24;  // lines in reach of a place to either side
  half_ = length() / 2;
  for (int i = 0; i + 1 < count_; ++i) {
    const double fastest = std::max(moving_[at(i)].norm(), moving_[at(i + 1)].norm());
    half_ = std::min(half_, shared(zones_[at(i)], fastest));
  }
  for (int i = 0; i + kWithin <= count_; ++i) {
    half_ = std::min(half_, at_[at(i + kWithin)] - at_[at(i)]);
  }
}

int Chain::line_at(double place) const noexcept {
  const double* begin = at_.data();
  return std::clamp(static_cast<int>(std::upper_bound(begin, begin + count_, place) - begin) - 1, 0, count_ - 1);
}

// At its ends a path has to be where the lines are, so the mean is narrower there.
Chain::Window Chain::window(double place) const noexcept {
  const double half = half_ * narrowed(place / half_) * narrowed((length() - place) / half_);
  return {half, line_at(place - half), line_at(place + half)};
}

double Chain::ramp(int i, double place, double half) const noexcept {
  const double beyond = place - at_[at(i)];
  if (std::abs(beyond) >= half) {
    return std::max(beyond, 0.0);
  }
  return half * sum_of_sums(beyond / half);
}

Pose Chain::pose_at(double place) const noexcept {
  place = std::clamp(place, 0.0, length());
  const Window w = window(place);
  const auto first = at(w.first);
  Pose pose;
  pose.position = poses_[first].position + moving_[first] * (place - at_[first]);
  for (int i = w.first + 1; i <= w.last; ++i) {
    pose.position += (moving_[at(i)] - moving_[at(i) - 1]) * ramp(i, place, w.half);
  }
  pose.orientation = poses_[first].orientation;
  double before = place - at_[first];
  for (int i = w.first; i <= w.last; ++i) {
    const double behind = ramp(i + 1, place, w.half);
    const double part = (before - behind) / (at_[at(i + 1)] - at_[at(i)]);
    pose.orientation = pose.orientation * rotation_by(std::clamp(part, 0.0, 1.0) * turns_[at(i)]);
    before = behind;
  }
  return pose;
}

LineLimits Chain::limits_at(double place) const noexcept {
  place = std::clamp(place, 0.0, length());
  const Window w = window(place);
  const auto first = at(w.first);
  double speed = speeds_[first];
  Shape shape;
  shape.moving = moving_[first];
  shape.turning = turning_[first];
  for (int i = w.first + 1; i <= w.last; ++i) {
    const double u = (place - at_[at(i)]) / w.half;
    if (std::abs(u) >= 1) {
      continue;
    }
    speed = std::min(speed, speeds_[at(i)]);
    const Vec3 change = moving_[at(i)] - moving_[at(i) - 1];
    const Vec3 turn_change = turning_[at(i)] - turning_[at(i) - 1];
    shape.moving += sum(u) * change;
    shape.turning += sum(u) * turn_change;
    shape.bend += weight(u) / w.half * change;
    shape.turn_bend += weight(u) / w.half * turn_change;
    shape.twist += weight_change(u) / (w.half * w.half) * change;
    shape.turn_twist += weight_change(u) / (w.half * w.half) * turn_change;
  }
  return limits_for(shape, speed, tool_);
}

int Chain::source_at(double place) const noexcept {
  return sources_[at(line_at(place))];
}

}  // namespace indurop::robot
