// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/time_profile.h"

#include <algorithm>
#include <cmath>

#include "control/robot/kinematics/bisect.h"

namespace indurop::robot {

namespace {

// Functions of polynomials, the lowest power first.
template <std::size_t N>
double value(const std::array<double, N>& p, double t) noexcept {
  double sum = 0;
  for (std::size_t i = N; i-- > 0;) {
    sum = sum * t + p[i];
  }
  return sum;
}

template <std::size_t N>
std::array<double, N - 1> derivative(const std::array<double, N>& p) noexcept {
  std::array<double, N - 1> d{};
  for (std::size_t i = 1; i < N; ++i) {
    d[i - 1] = static_cast<double>(i) * p[i];
  }
  return d;
}

// ProfilePlaces where the direction may change, including 0 and the end.
struct ProfilePlaces {
  std::array<double, 8> at{};
  std::size_t count = 0;
  void add(double place) noexcept { at[count++] = place; }
};

// Finds a root between two places between which the polynomial is monotonic.
template <std::size_t N>
double zero_between(const std::array<double, N>& p, double low, double high) noexcept {
  const bool rises = value(p, low) < 0;
  return bisect({low, high}, 24, [&](double place) { return (value(p, place) < 0) == rises; }).middle();
}

// Returns 0, the roots inside, and the end; there is at most one root between two zeros of the derivative.
template <std::size_t N>
ProfilePlaces zeros(const std::array<double, N>& p, double end) noexcept {
  ProfilePlaces found;
  found.add(0);
  if constexpr (N > 1) {
    const ProfilePlaces turns = zeros(derivative(p), end);
    for (std::size_t i = 0; i + 1 < turns.count; ++i) {
      if ((value(p, turns.at[i]) < 0) != (value(p, turns.at[i + 1]) < 0)) {
        found.add(zero_between(p, turns.at[i], turns.at[i + 1]));
      }
    }
  }
  found.add(end);
  return found;
}

template <std::size_t N>
void widen(TimeProfile::Range& range, const std::array<double, N>& p, double end) noexcept {
  const ProfilePlaces turns = zeros(derivative(p), end);
  for (std::size_t i = 0; i < turns.count; ++i) {
    const double there = value(p, turns.at[i]);
    range = {std::min(range.least, there), std::max(range.greatest, there)};
  }
}

}  // namespace

// The start and the points of the table.
struct TimeProfile::Points {
  static constexpr std::size_t kMaxPoints = kProfilePoints + 1;
  std::array<double, kMaxPoints> time{};
  std::array<double, kMaxPoints> value{};
  std::size_t last = 0;
  [[nodiscard]] double width(std::size_t i) const noexcept { return time[i + 1] - time[i]; }
  [[nodiscard]] double steep(std::size_t i) const noexcept { return (value[i + 1] - value[i]) / width(i); }
};

double TimeProfile::Range::peak() const noexcept {
  return std::max(std::abs(least), std::abs(greatest));
}

ErrorCode TimeProfile::set(const ProfileTable& table, Of of, const Scale& scale, const LineState& start) noexcept {
  constexpr double kLeastTime = 1e-6;  // s, between two points
  if (table.points < 1 || table.points > static_cast<int>(kProfilePoints) || !std::isfinite(scale.time) ||
      !(scale.time > 0) || !std::isfinite(scale.value) || !std::isfinite(scale.offset)) {
    return ErrorCode::Value;
  }
  Points points;
  points.last = static_cast<std::size_t>(table.points);
  points.value[0] = of == Of::Position ? start.position : of == Of::Velocity ? start.velocity : start.acceleration;
  for (std::size_t i = 0; i < points.last; ++i) {
    points.time[i + 1] = scale.time * table.time[i];
    points.value[i + 1] = scale.value * table.value[i] + scale.offset;
    if (!std::isfinite(points.time[i + 1]) || !(points.width(i) >= kLeastTime) || !std::isfinite(points.value[i + 1])) {
      return ErrorCode::Value;
    }
  }
  count_ = points.last;
  duration_ = points.time[points.last];
  for (std::size_t i = 0; i < count_; ++i) {
    segments_[i] = {points.time[i], points.width(i), {}};
  }
  switch (of) {
    case Of::Position:
      through_positions(points, start);
      break;
    case Of::Velocity:
      through_velocities(points, start);
      break;
    case Of::Acceleration:
      through_accelerations(points, start);
  }
  return ErrorCode::Ok;
}

// Slopes of the cubic spline from the initial speed to rest, and its second derivative at each point. Each part is the
// only polynomial of fifth order with position, slope and second derivative of both its ends.
void TimeProfile::through_positions(const Points& points, const LineState& start) noexcept {
  const std::size_t last = points.last;
  std::array<double, Points::kMaxPoints> slopes{};
  std::array<double, Points::kMaxPoints> scaled{};
  slopes[0] = start.velocity;
  for (std::size_t i = 1; i < last; ++i) {
    const double before = 1 / points.width(i - 1);
    const double behind = 1 / points.width(i);
    const double pivot = 2 * (before + behind) - before * scaled[i - 1];
    const double right = 3 * (points.steep(i - 1) * before + points.steep(i) * behind);
    scaled[i] = behind / pivot;
    slopes[i] = (right - before * slopes[i - 1]) / pivot;
  }
  for (std::size_t i = last - 1; i > 0; --i) {
    slopes[i] -= scaled[i] * slopes[i + 1];
  }
  double bend = start.acceleration;
  for (std::size_t i = 0; i < last; ++i) {
    const double h = points.width(i);
    const double next_bend =
        i + 1 < last ? (6 * points.steep(i + 1) - 4 * slopes[i + 1] - 2 * slopes[i + 2]) / points.width(i + 1) : 0;
    const double rest = points.value[i + 1] - points.value[i] - h * (slopes[i] + h * bend / 2);
    const double rest_slope = h * (slopes[i + 1] - slopes[i] - h * bend);
    const double rest_bend = h * h * (next_bend - bend);
    segments_[i].way = {points.value[i],
                        slopes[i],
                        bend / 2,
                        (10 * rest - 4 * rest_slope + rest_bend / 2) / (h * h * h),
                        (-15 * rest + 7 * rest_slope - rest_bend) / (h * h * h * h),
                        (6 * rest - 3 * rest_slope + rest_bend / 2) / (h * h * h * h * h)};
    bend = next_bend;
  }
}

// Third order between two velocities. At a maximum or minimum the curve is level, else its slope is the harmonic mean
// of those on both sides: no part leaves the range between its ends.
void TimeProfile::through_velocities(const Points& points, const LineState& start) noexcept {
  double position = start.position;
  double slope = start.acceleration;
  for (std::size_t i = 0; i < points.last; ++i) {
    const double h = points.width(i);
    double next = 0;
    if (i + 1 < points.last && points.steep(i) * points.steep(i + 1) > 0) {
      const double one = 2 * points.width(i + 1) + h;
      const double other = points.width(i + 1) + 2 * h;
      next = (one + other) / (one / points.steep(i) + other / points.steep(i + 1));
    }
    const double square = (3 * points.steep(i) - 2 * slope - next) / h;
    const double cube = (slope + next - 2 * points.steep(i)) / (h * h);
    segments_[i].way = {position, points.value[i], slope / 2, square / 3, cube / 4, 0};
    position = value(segments_[i].way, h);
    slope = next;
  }
}

void TimeProfile::through_accelerations(const Points& points, const LineState& start) noexcept {
  LineState state = start;
  for (std::size_t i = 0; i < points.last; ++i) {
    const double h = points.width(i);
    const double jerk = points.steep(i);
    segments_[i].way = {state.position, state.velocity, state.acceleration / 2, jerk / 6, 0, 0};
    state.position = value(segments_[i].way, h);
    state.velocity += h * (state.acceleration + h * jerk / 2);
    state.acceleration = points.value[i + 1];
  }
}

LineState TimeProfile::at(double time) const noexcept {
  if (count_ == 0) {
    return {};
  }
  const double within = std::clamp(time, 0.0, duration_);
  const auto* const begin = segments_.begin();
  const auto* const next = std::upper_bound(begin + 1, begin + count_, within,
                                            [](double t, const Segment& segment) { return t < segment.begin; });
  const Segment& segment = *(next - 1);
  const double t = std::min(within - segment.begin, segment.duration);
  const auto speed = derivative(segment.way);
  const double velocity = value(speed, t);
  return {value(segment.way, t) + std::max(0.0, time - duration_) * velocity, velocity, value(derivative(speed), t)};
}

TimeProfile::Ranges TimeProfile::ranges() const noexcept {
  constexpr Range kNone{HUGE_VAL, -HUGE_VAL};
  Ranges ranges{kNone, kNone, kNone, kNone};
  for (std::size_t i = 0; i < count_; ++i) {
    const double end = segments_[i].duration;
    const auto speed = derivative(segments_[i].way);
    const auto change = derivative(speed);
    widen(ranges.position, segments_[i].way, end);
    widen(ranges.velocity, speed, end);
    widen(ranges.acceleration, change, end);
    widen(ranges.jerk, derivative(change), end);
  }
  return ranges;
}

}  // namespace indurop::robot
