// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/joint_path.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

// Rises from 0 at -1 to 1 at 1; before and after that it would be 0 and `u`. Its second derivative is (1 - u^2)^2,
// times a constant.
double bent(double u) noexcept {
  const double square = u * u;
  return 5.0 / 32 + u / 2 + square * (15.0 / 32 + square * (-5.0 / 32 + square / 32));
}

double overlap(double from, double to, double low, double high) noexcept {
  return std::max(0.0, std::min(to, high) - std::max(from, low));
}

}  // namespace

void JointPath::begin(const Joints& from) noexcept {
  count_ = 1;
  points_[0] = from;
  places_[0] = zones_[0] = 0;
}

bool JointPath::add(const Joints& to, const Joints& velocity) noexcept {
  const Joints way = to - points_[at_index(count_ - 1)];
  const double seconds = way.cwiseAbs().cwiseQuotient(velocity).maxCoeff();
  if (count_ == kMostPoints || !(seconds > 0)) {
    return false;
  }
  directions_[at_index(count_ - 1)] = way / seconds;
  points_[at_index(count_)] = to;
  places_[at_index(count_)] = places_[at_index(count_ - 1)] + seconds;
  zones_[at_index(count_++)] = 0;
  return true;
}

int JointPath::piece_at(double place) const noexcept {
  const auto* const begin = places_.data();
  const auto* const found = std::upper_bound(begin + 1, begin + count_ - 1, place);
  return static_cast<int>(found - begin) - 1;
}

Joints JointPath::at(double place) const noexcept {
  if (count_ < 2) {
    return points_[0];
  }
  const int piece = piece_at(place);
  const auto k = at_index(piece);
  const double after = std::max(0.0, place - places_[k]);
  const double before = std::max(0.0, places_[k + 1] - place);
  if (after >= zones_[k] && before >= zones_[k + 1]) {
    return after < before ? Joints(points_[k] + after * directions_[k])
                          : Joints(points_[k + 1] - before * directions_[k]);
  }
  const std::size_t corner = after < zones_[k] ? k : k + 1;
  const double from_corner = corner == k ? after : -before;
  const double zone = zones_[corner];
  return points_[corner] + from_corner * directions_[corner - 1] +
         zone * bent(from_corner / zone) * (directions_[corner] - directions_[corner - 1]);
}

// On a corner, the direction goes from that of one piece to that of the next, without detours.
Joints JointPath::travel(double from, double to) const noexcept {
  Joints sum = Joints::Zero();
  const int last = piece_at(to);
  for (int piece = piece_at(from); piece <= last; ++piece) {
    const auto k = at_index(piece);
    const Joints here = directions_[k].cwiseAbs();
    const double begin = places_[k];
    const double end = places_[k + 1];
    sum += here * overlap(from, to, begin + zones_[k], end - zones_[k + 1]);
    if (const double part = overlap(from, to, begin, begin + zones_[k]); part > 0) {
      sum += part * here.cwiseMax(directions_[k - 1].cwiseAbs());
    }
    if (const double part = overlap(from, to, end - zones_[k + 1], end); part > 0) {
      sum += part * here.cwiseMax(directions_[k + 1].cwiseAbs());
    }
  }
  return sum;
}

Joints JointPath::fastest() const noexcept {
  Joints most = Joints::Zero();
  for (std::size_t k = 0; k + 1 < at_index(count_); ++k) {
    most = most.cwiseMax(directions_[k].cwiseAbs());
  }
  return most;
}

double JointPath::smooth_until(double place) const noexcept {
  constexpr double kRounding = 1e-9;
  for (int i = 1; i + 1 < count_; ++i) {
    for (const double part : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      const double bound = places_[at_index(i)] + part * zones_[at_index(i)];
      if (bound > place + kRounding) {
        return bound;
      }
    }
  }
  return HUGE_VAL;
}

}  // namespace indurop::robot
