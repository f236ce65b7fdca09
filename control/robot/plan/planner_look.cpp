// SPDX-License-Identifier: Apache-2.0
// The closer check of parts of a path, and its results.

#include <algorithm>
#include <cmath>

#include "control/robot/plan/planner.h"

namespace indurop::robot {

// Returns whether a joint may be beyond its limits between places i and i + 1, with twice the bend of a parabola
// through them and their neighbours.
bool Planner::may_leave_range(const Joints* places, int count, int i) const noexcept {
  const auto bend = [&](int k) {
    const int m = std::clamp(k, 1, count - 1);
    return (places[m + 1] - 2 * places[m] + places[m - 1]).cwiseAbs();
  };
  const Joints more = bend(i).cwiseMax(bend(i + 1)) / 4;
  return places_.arm().beyond_limits(places[i].cwiseMax(places[i + 1]) + more) >= 0 ||
         places_.arm().beyond_limits(places[i].cwiseMin(places[i + 1]) - more) >= 0;
}

// Selects the parts to be checked more closely: where joints are near a limit, where one may be beyond its range, and
// where their speed rises so fast that it may have a peak between two places.
void Planner::choose_windows(const Joints* places, const double* volumes, int count, double from, double spacing,
                             int depth) noexcept {
  constexpr double kNear = 0.4;  // of a limit
  double before = pace(rates_at(places, count, 0, spacing), joints_);
  for (int i = 0; i < count && windows_ < static_cast<int>(window_.size()); ++i) {
    const Rates rates = rates_at(places, count, i, spacing);
    const double now = pace(rates, joints_);
    const double next = pace(rates_at(places, count, std::min(i + 1, count - 1), spacing), joints_);
    const double most = std::max({before, now, next});
    const double growth = most / std::max(std::min({before, now, next}), 1e-9);
    const double v = segment_.limits.velocity;
    const bool near = velocity_for(rates, joints_, HUGE_VAL) * kNear < v;
    if (may_be_singular(volumes, count, i) || may_leave_range(places, count, i) ||
        (growth > (near ? 1.15 : 1.5) && most * v > 0.1)) {
      window_[static_cast<std::size_t>(windows_++)] = {from + spacing * i, spacing, places[i], places[i + 1], depth};
    }
    before = now;
  }
}

Fault Planner::look_closer() noexcept {
  constexpr int kDeepest = 3;
  const Window window = window_[static_cast<std::size_t>(--windows_)];
  std::array<Joints, kParts + 1> places;
  std::array<double, kParts + 1> volumes{};
  places[0] = window.start;
  volumes[0] = volume(places[0]);
  const double spacing = window.length / kParts;
  for (int i = 1; i <= kParts; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double from = window.from + spacing * (i - 1);
    if (const Fault fault = walk(from, places[k - 1], from + spacing, places[k]); !fault.ok()) {
      return fault;
    }
    volumes[k] = volume(places[k]);
    note_volume(volumes[k], from + spacing, places[k]);
  }
  Eigen::Index axis = 0;
  if ((places[kParts] - window.end).cwiseAbs().maxCoeff(&axis) > 1e-6) {
    return {ErrorCode::Singular, static_cast<int>(axis) + 1};  // a closer check arrives in another posture
  }
  Rates most;
  for (int i = 0; i < kParts; ++i) {
    const Rates rates = rates_at(places.data(), kParts, i, spacing);
    most = {most.first.cwiseMax(rates.first), most.second.cwiseMax(rates.second), most.third.cwiseMax(rates.third)};
    bound(rates, window.from + spacing * i, spacing, places[static_cast<std::size_t>(i)]);
  }
  note(most);
  if (window.depth < kDeepest) {
    choose_windows(places.data(), volumes.data(), kParts, window.from, spacing, window.depth + 1);
  }
  return {};
}

void Planner::note_volume(double volume, double place, const Joints& q) noexcept {
  if (std::abs(volume) < least_volume_) {
    least_volume_ = std::abs(volume);
    narrow_[0] = {place, q};
  }
}

// Bounds of the speed in a part of the path that begins at `q`, and of its changes there.
void Planner::bound(const Rates& rates, double from, double length, const Joints& q) noexcept {
  constexpr double kChanging = 0.7;  // of a joint's acceleration
  const double part = segment_.length / PathBounds::kParts;
  const int first = std::clamp(static_cast<int>(from / part + 0.001), 0, PathBounds::kParts - 1);
  const int last = std::clamp(static_cast<int>((from + length) / part - 0.001), first, PathBounds::kParts - 1);
  const double speed = velocity_for(rates, joints_, HUGE_VAL);
  const double acceleration = kChanging / rates.first.cwiseQuotient(joints_.acceleration).maxCoeff();
  if (speed < slowest_) {
    slowest_ = speed;
    narrow_[1] = {from, q};
  }
  for (int i = first; i <= last; ++i) {
    const auto k = static_cast<std::size_t>(i);
    bounds_.speed[k] = std::min(bounds_.speed[k], speed);
    bounds_.acceleration[k] = std::min(bounds_.acceleration[k], acceleration);
  }
}

// Entries that do not fit are merged into the last one, which can only make the path slower.
void Planner::note(const Rates& rates) noexcept {
  segment_.limits.velocity = velocity_for(rates, joints_, segment_.limits.velocity);
  if (noted_ < static_cast<int>(rates_.size())) {
    rates_[static_cast<std::size_t>(noted_++)] = rates;
    return;
  }
  Rates& last = rates_.back();
  last = {last.first.cwiseMax(rates.first), last.second.cwiseMax(rates.second), last.third.cwiseMax(rates.third)};
}

}  // namespace indurop::robot
