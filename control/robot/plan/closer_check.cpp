// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/closer_check.h"

#include <algorithm>
#include <cmath>

#include "control/robot/plan/posture_walk.h"

namespace indurop::robot {

// Returns whether a joint may be beyond its limits between places i and i + 1, with twice the bend of a parabola
// through them and their neighbours.
bool CloserCheck::may_leave_range(const Joints* places, int count, int i) const noexcept {
  const auto bend = [&](int k) {
    const int m = std::clamp(k, 1, count - 1);
    return (places[m + 1] - 2 * places[m] + places[m - 1]).cwiseAbs();
  };
  const Joints more = bend(i).cwiseMax(bend(i + 1)) / 4;
  return places_.arm().beyond_limits(places[i].cwiseMax(places[i + 1]) + more) >= 0 ||
         places_.arm().beyond_limits(places[i].cwiseMin(places[i + 1]) - more) >= 0;
}

// These are the parts where joints are near a limit, where one may be beyond its range, and where their speed rises so
// fast that it may have a peak between two places.
void CloserCheck::choose(const Joints* places, const double* volumes, int count, double from, double spacing,
                         int depth) noexcept {
  constexpr double kNear = 0.4;  // of a limit
  const JointLimits& joints = draft_.joints;
  double before = pace(rates_at(places, count, 0, spacing), joints);
  for (int i = 0; i < count && count_ < parts_.size(); ++i) {
    const Rates rates = rates_at(places, count, i, spacing);
    const double now = pace(rates, joints);
    const double next = pace(rates_at(places, count, std::min(i + 1, count - 1), spacing), joints);
    const double most = std::max({before, now, next});
    const double growth = most / std::max(std::min({before, now, next}), 1e-9);
    const double v = draft_.segment.limits.velocity;
    const bool near = velocity_for(rates, joints, HUGE_VAL) * kNear < v;
    if (may_be_singular(volumes, count, i) || may_leave_range(places, count, i) ||
        (growth > (near ? 1.15 : 1.5) && most * v > 0.1)) {
      parts_[count_++] = {from + spacing * i, spacing, places[i], places[i + 1], depth};
    }
    before = now;
  }
}

Fault CloserCheck::check_next() noexcept {
  constexpr int kDeepest = 3;
  const Part part = parts_[--count_];
  std::array<Joints, kPlaces + 1> places;
  std::array<double, kPlaces + 1> volumes{};
  places[0] = part.start;
  volumes[0] = places_.arm().volume(places[0]);
  const double spacing = part.length / kPlaces;
  for (int i = 1; i <= kPlaces; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double from = part.from + spacing * (i - 1);
    if (const Fault fault = walk_in_posture(places_, draft_, from, places[k - 1], from + spacing, places[k]);
        !fault.ok()) {
      return fault;
    }
    volumes[k] = places_.arm().volume(places[k]);
    findings_.note_volume(volumes[k], from + spacing, places[k]);
  }
  Eigen::Index axis = 0;
  if ((places[kPlaces] - part.end).cwiseAbs().maxCoeff(&axis) > 1e-6) {
    return {ErrorCode::Singular, static_cast<int>(axis) + 1};  // a closer check arrives in another posture
  }
  Rates most;
  for (int i = 0; i < kPlaces; ++i) {
    const Rates rates = rates_at(places.data(), kPlaces, i, spacing);
    most = {most.first.cwiseMax(rates.first), most.second.cwiseMax(rates.second), most.third.cwiseMax(rates.third)};
    findings_.bound(rates, part.from + spacing * i, spacing, places[static_cast<std::size_t>(i)]);
  }
  findings_.note(most);
  if (part.depth < kDeepest) {
    choose(places.data(), volumes.data(), kPlaces, part.from, spacing, part.depth + 1);
  }
  return {};
}

}  // namespace indurop::robot
