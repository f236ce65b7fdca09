// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/timing_search.h"

#include <algorithm>
#include <cmath>

#include "control/robot/path/rates.h"

namespace indurop::robot {

namespace {

constexpr double kPerKnot = 0.02;  // s, about
constexpr int kFewestKnots = 24;
constexpr double kMargin = 0.98;  // of the limits: margin for places between two knots
constexpr double kDenser = 0.2;
constexpr int kSmoothings = 16;  // a parameter that bends quickly has peaks of jerk between its knots
}  // namespace

void TimingSearch::begin(const Segment& segment, const PathBounds& bounds) noexcept {
  segment_ = segment;
  segment_.wave = {};  // has more bends than a timing has knots; its limits are in segment.most
  timing_ = {};
  near_ = segment.from;
  next_ = 0;
  per_knot_ = 1;
  too_coarse_ = false;
  slower_.fill(1);
  noted_.fill(1);
  stage_ = guess(bounds) ? Stage::Look : Stage::Done;
}

void TimingSearch::note(double time, double factor) noexcept {
  double& noted = noted_[at(timing_.piece_at(time))];
  noted = std::max(noted, factor);
}

void TimingSearch::refine() noexcept {
  for (int i = 0; i < count_ && per_knot_ > 1; ++i) {
    slower_[at(i)] *= noted_[at(i)] * noted_[at(i)];  // more than noted: peaks of jerk move a little
  }
  noted_.fill(1);
  near_ = segment_.from;
  next_ = 0;
  per_knot_ = 2;
  stage_ = Stage::Look;
}

// Reduces the times that knots are spread over, where there are not enough of them: those during which the speed
// remains the same need few.
void TimingSearch::count_calm_less(const PartTimes& square, PartTimes& time) noexcept {
  constexpr double kAround = 0.15;  // s before and after a change of the speed, and after rest
  constexpr double kLeast = 0.02;
  constexpr double kEnough = kPerKnot * PathTiming::kMaxPieces;  // s
  constexpr int kParts = PathBounds::kParts;
  if (time[kParts] <= kEnough) {
    return;
  }
  const double unchanged = 1e-6 * *std::max_element(square.begin(), square.end());
  std::array<bool, kParts> calm{};
  const auto changes = [&](int i) { return std::abs(square[at(i + 1)] - square[at(i)]) > unchanged; };
  double last = 0;
  for (int i = 0; i < kParts; ++i) {
    last = changes(i) ? time[at(i + 1)] : last;
    calm[at(i)] = time[at(i)] > last + kAround;
  }
  double next = time[kParts];
  double all = 0;
  for (int i = kParts - 1; i >= 0; --i) {
    next = changes(i) ? time[at(i)] : next;
    calm[at(i)] = calm[at(i)] && time[at(i + 1)] < next - kAround;
    all += calm[at(i)] ? time[at(i + 1)] - time[at(i)] : 0;
  }
  const double part = all > 0 ? std::clamp(1 - (time[kParts] - kEnough) / all, kLeast, 1.0) : 1;
  double before = time[0];
  for (int i = 0; i < kParts; ++i) {
    const double here = time[at(i + 1)];
    time[at(i + 1)] = time[at(i)] + (here - before) * (calm[at(i)] ? part : 1);
    before = here;
  }
}

// Places knots at equal times of a motion without jerk limits, so that they are dense where it is slow.
bool TimingSearch::guess(const PathBounds& bounds) noexcept {
  constexpr int kParts = PathBounds::kParts;
  const double step = segment_.length / kParts;
  PartTimes square{};
  square[0] = square[kParts] = 0;
  for (int i = 1; i < kParts; ++i) {
    const double v = std::min(bounds.speed[at(i - 1)], bounds.speed[at(i)]);
    square[at(i)] = std::min(v * v, square[at(i - 1)] + 2 * step * bounds.acceleration[at(i - 1)]);
  }
  for (int i = kParts - 1; i > 0; --i) {
    square[at(i)] = std::min(square[at(i)], square[at(i + 1)] + 2 * step * bounds.acceleration[at(i)]);
  }
  PartTimes time{};
  for (int i = 0; i < kParts; ++i) {
    time[at(i + 1)] = time[at(i)] + 2 * step / (std::sqrt(square[at(i)]) + std::sqrt(square[at(i + 1)]));
  }
  count_calm_less(square, time);
  const double duration = time[kParts] + 0.1;  // jerk limits cost time at both ends
  if (!std::isfinite(duration)) {
    return false;
  }
  count_ = std::clamp(static_cast<int>(duration / kPerKnot), kFewestKnots, PathTiming::kMaxPieces);
  int part = 0;
  for (int i = 0; i <= count_; ++i) {
    // Denser at the ends, where jerk is the limit.
    const double y = static_cast<double>(i) / count_;
    const double t = time[kParts] * (y - kDenser * std::sin(2 * kPi * y) / (2 * kPi));
    while (part < kParts - 1 && time[at(part + 1)] < t) {
      ++part;
    }
    const double inside = (t - time[at(part)]) / (time[at(part + 1)] - time[at(part)]);
    shape_[at(i + 2)] = step * (part + std::clamp(inside, 0.0, 1.0));
  }
  for (int pass = 0; pass < kSmoothings; ++pass) {
    smooth_ends();
    double before = shape_[at(4)];
    for (int i = 5; i <= count_ - 1; ++i) {
      const double here = shape_[at(i)];
      shape_[at(i)] = (before + 2 * here + shape_[at(i + 1)]) / 4;
      before = here;
    }
  }
  smooth_ends();
  return true;
}

// Makes the path the cube of the parameter at both ends, as a jerk-limited motion begins.
void TimingSearch::smooth_ends() noexcept {
  constexpr double kCube[] = {0, -0.5, 5, 22.5};
  const double length = segment_.length;
  const double first = shape_[5] / kCube[3];
  const double last = (length - shape_[at(count_ - 1)]) / kCube[3];
  for (int i = 0; i <= 2; ++i) {
    const double c = kCube[i];
    shape_[at(2 + i)] = c * first;
    shape_[at(2 - i)] = -c * first;
    shape_[at(count_ + 2 - i)] = length - c * last;
    shape_[at(count_ + 2 + i)] = length + c * last;
  }
}

// Place and derivatives with respect to the parameter.
PathTiming::Value TimingSearch::place_at(int index) const noexcept {
  const double* c = shape_.data() + index / per_knot_;
  if (index % per_knot_ == 0) {
    return {(c[0] + 26 * c[1] + 66 * c[2] + 26 * c[3] + c[4]) / 120, (c[4] - c[0] + 10 * (c[3] - c[1])) / 24,
            (c[0] + 2 * c[1] - 6 * c[2] + 2 * c[3] + c[4]) / 6, (c[4] - 2 * c[3] + 2 * c[1] - c[0]) / 2};
  }
  return {(c[0] + c[5] + 237 * (c[1] + c[4]) + 1682 * (c[2] + c[3])) / 3840,
          (c[5] - c[0] + 75 * (c[4] - c[1]) + 154 * (c[3] - c[2])) / 384,
          (c[0] + c[5] + 21 * (c[1] + c[4]) - 22 * (c[2] + c[3])) / 48,
          (c[5] - c[0] + 3 * (c[4] - c[1]) - 14 * (c[3] - c[2])) / 8};
}

bool TimingSearch::look(int index) noexcept {
  const PathTiming::Value g = place_at(index);
  const double g1 = g.first;
  const double g2 = g.second;
  const double g3 = g.third;
  // Steps are not longer than the features of the path: next to a singular position these are short.
  const double e = std::min({2e-4, segment_.length / 64, std::max(4 * g1, 1e-9 * segment_.length)});
  const double middle = std::clamp(g.value, 2 * e, segment_.length - 2 * e);
  std::array<Joints, 5> q;
  for (int i = 0; i < 5; ++i) {
    if (places_.on(segment_, middle + e * (i - 2), near_, near_) != Reach::Ok) {
      return false;
    }
    q[at(i)] = near_;
  }
  const Joints first = (q[0] - 8 * q[1] + 8 * q[3] - q[4]) / (12 * e);
  const Joints second = (-q[0] + 16 * q[1] - 30 * q[2] + 16 * q[3] - q[4]) / (12 * e * e);
  const Joints third = (q[4] - 2 * q[3] + 2 * q[1] - q[0]) / (2 * e * e * e);
  TimingPlace& k = barrier_.place(index);
  const double slower =
      std::max(slower_[at(std::max(index - 1, 0) / per_knot_)], slower_[at(std::min(index / per_knot_, count_ - 1))]);
  const auto row = [&](int i, double d1, double d2, double d3, const LineLimits& most) {
    const double x1 = d1 * g1;
    const double x2 = d2 * g1 * g1 + d1 * g2;
    const double x3 = d3 * g1 * g1 * g1 + 3 * d2 * g1 * g2 + d1 * g3;
    const double v = (i < kAxes ? kMargin / slower : 1) * most.velocity / std::max(std::abs(x1), 1e-12);
    k.fastest = std::min(k.fastest, v * v);
    const double a = slower * slower / (TimingShares::kAcceleration * kMargin * most.acceleration);
    const double j = slower * slower * slower / (TimingShares::kJerk * kMargin * most.jerk);
    k.bend[at(i)] = x2 * a;
    k.drive[at(i)] = x1 * a / 2;
    k.third[at(i)] = x3 * j;
    k.mixed[at(i)] = 1.5 * x2 * j;
    k.last[at(i)] = x1 * j / 2;
  };
  k.fastest = 1e12;
  for (int i = 0; i < kAxes; ++i) {
    row(i, first[i], second[i], third[i], {joints_.velocity[i], joints_.acceleration[i], joints_.jerk[i]});
  }
  if (segment_.chain == nullptr) {
    row(kAxes, 1, 0, 0, segment_.most);
    return true;
  }
  const ToolPath::Shape tool = segment_.chain->shape_at(g.value);
  const ToolLimits& most = segment_.chain->tool();
  const LineLimits& along = segment_.most;
  row(kAxes, 1, 0, 0, {std::min(tool.speed, along.velocity), along.acceleration, along.jerk});
  for (int i = 0; i < 3; ++i) {
    row(TimingPlace::kMoving + i, tool.moving[i], tool.bend[i], tool.twist[i],
        {HUGE_VAL, most.acceleration, most.jerk});
    row(TimingPlace::kTurning + i, tool.turning[i], tool.turn_bend[i], tool.turn_twist[i],
        {HUGE_VAL, most.turn_acceleration, most.turn_jerk});
  }
  return true;
}

int TimingSearch::work() noexcept {
  if (stage_ == Stage::Look) {
    if (!look(next_)) {
      stage_ = Stage::Done;
    } else if (++next_ > count_ * per_knot_) {
      barrier_.begin(count_, per_knot_, segment_.chain != nullptr ? TimingPlace::kVectors : 0);
      stage_ = Stage::Search;
    }
    return 5;
  }
  const int places = barrier_.work();
  if (barrier_.done()) {
    PathTiming found;
    found.set(count_, shape_.data(), barrier_.squares());
    const bool good = std::isfinite(found.duration());  // else the square of a speed is negative between two places
    too_coarse_ = !good && per_knot_ == 1;
    if (good) {
      timing_ = found;
    }
    stage_ = Stage::Done;
  }
  return places;
}

}  // namespace indurop::robot
