// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/path_survey.h"

#include <algorithm>
#include <cmath>

#include "control/robot/plan/posture_walk.h"

namespace indurop::robot {

namespace {

constexpr int kFewestPlaces = 24;        // places
constexpr double kSpacing = 0.01;        // m between checked places
constexpr double kChainSpacing = 0.005;  // m, of a path that consists of many pieces

// An arm with few axes may not reach the orientation: compares it with the one that it reaches.
bool misses_orientation(const Arm& arm, const Pose& pose, const Joints& q) noexcept {
  constexpr double kTurned = 2e-3;  // rad
  return arm.count() < 6 && rotation_between(arm.forward(q).orientation, pose.orientation).norm() > kTurned;
}

}  // namespace

PathSurvey::PathSurvey(const Places& places, Draft& draft) noexcept
    : places_(places),
      draft_(draft),
      findings_(places, draft),
      closer_(places, draft, findings_),
      inside_(places.box(), Vec3::Zero()) {}

void PathSurvey::begin() noexcept {
  const Segment& s = draft_.segment;
  const bool chain = s.chain != nullptr;
  const double elbow = s.elbow_moves ? (s.elbow - s.from).cwiseAbs().maxCoeff() : 0;
  const double finest = std::max({s.way, 0.3 * s.turn.norm(), 0.3 * elbow}) / (chain ? kChainSpacing : kSpacing);
  count_ = s.joint_path != nullptr ? kMaxPlaces
                                   : std::clamp(static_cast<int>(std::min(finest, 1e6)), kFewestPlaces,
                                                chain ? kMaxPlaces : kMaxPlaces / 2);
  next_ = 1;
  samples_[0] = s.from;
  volumes_[0] = places_.arm().volume(s.from);
  inside_ = {places_.box(), s.start.position};
  findings_.begin();
  closer_.begin();
  wanted_ = Profile::to_position({}, s.length, 0, s.limits).peak().velocity;
}

Fault PathSurvey::check(int& places) noexcept {
  for (; places > 0 && next_ <= count_; --places, ++next_) {
    if (const Fault fault = check_next(); !fault.ok()) {
      return fault;
    }
    if (next_ == count_) {
      learn();
    }
  }
  for (; places > 0 && next_ > count_ && !closer_.done(); places -= CloserCheck::kPlaces) {
    if (const Fault fault = closer_.check_next(); !fault.ok()) {
      return fault;
    }
  }
  return done() ? finish() : Fault{};
}

Fault PathSurvey::check_next() noexcept {
  const double spacing = draft_.segment.length / count_;
  draft_.blame(spacing * next_);
  const auto k = static_cast<std::size_t>(next_);
  Joints& here = samples_[k];
  if (const Fault fault =
          walk_in_posture(places_, draft_, spacing * (next_ - 1), samples_[k - 1], spacing * next_, here);
      !fault.ok()) {
    return fault;
  }
  if (places_.box().known() && !inside_.next(places_.arm().forward(here).position)) {
    return {ErrorCode::Workspace};
  }
  if (draft_.segment.chain != nullptr) {
    const double part = 1.0 / count_;
    wanted_ = std::min(wanted_, findings_.bound_tool(part * (next_ - 1), part * next_));
  }
  volumes_[k] = places_.arm().volume(here);
  findings_.note_volume(volumes_[k], spacing * next_, here);
  if (draft_.segment.joint_path == nullptr &&
      misses_orientation(places_.arm(), draft_.segment.pose_at(spacing * next_), here)) {
    draft_.work.settle_slowly();
  }
  return {};
}

// All places are known: how fast the path may be followed between them, and where that has to be checked more closely.
void PathSurvey::learn() noexcept {
  const double spacing = draft_.segment.length / count_;
  for (int i = 0; i < count_; ++i) {
    const Rates rates = rates_at(samples_.data(), count_, i, spacing);
    findings_.note(rates);
    findings_.bound(rates, spacing * i, spacing, samples_[static_cast<std::size_t>(i)]);
    if (i > 0) {
      findings_.note_turn(&samples_[static_cast<std::size_t>(i) - 1]);
    }
  }
  closer_.choose(samples_.data(), volumes_.data(), count_, 0, spacing, 0);
}

Fault PathSurvey::finish() noexcept {
  Segment& s = draft_.segment;
  s.to = samples_[static_cast<std::size_t>(count_)];
  TipSpeed tip(places_.arm());
  tip.begin(samples_[0]);
  for (int i = 1; i <= count_; ++i) {
    tip.note(samples_[static_cast<std::size_t>(i)]);
  }
  s.tip_speed = tip.farthest() * count_ / s.length;
  const bool misses =
      draft_.misses_end() || (s.joint_path == nullptr && misses_orientation(places_.arm(), s.end, s.to));
  return {misses ? ErrorCode::Unreachable : ErrorCode::Ok};
}

bool PathSurvey::find(double place, const Joints& near, Joints& q) const noexcept {
  const double sample = place / draft_.segment.length * count_;
  const double nearest = std::round(sample);
  const double off = std::abs(sample - nearest);
  q = off < 0.25 ? samples_[static_cast<std::size_t>(std::clamp(nearest, 0.0, double{kMaxPlaces}))] : near;
  return off < 1e-9;
}

}  // namespace indurop::robot
