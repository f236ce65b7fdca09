// SPDX-License-Identifier: Apache-2.0
// What comes behind the look at a path: its timing, and a rehearsal of the motion.

#include "robot/planner.h"

namespace indurop::robot {

namespace {

constexpr double kStep = 0.005;      // s between instants of a motion that are looked at
constexpr double kFineStep = 0.001;  // near singular positions
constexpr double kNearlyOne = 1.02;
constexpr int kMostRehearsals = 4;

}  // namespace

void Planner::search() noexcept {
  if (!search_.done()) {
    return;
  }
  const PathTiming& found = search_.timing();
  if (found.known()) {
    segment_.timing = found;
    rehearse_timing();
  } else {
    rehearse_profile();
  }
}

void Planner::rehearse_timing() noexcept {
  rehearsal_.begin(segment_.from, segment_.timing.duration(), nearly_singular() ? kFineStep : kStep);
  stage_ = Stage::RehearseTiming;
}

// Where joint speeds change abruptly, not only the places but the motion itself is looked at, at one speed too.
void Planner::rehearse_profile() noexcept {
  profile_ = Profile::to_position({}, segment_.length, 0, segment_.limits);
  stage_ = Stage::Done;
  if (nearly_singular()) {
    rehearsal_.begin(segment_.from, profile_.duration(), kFineStep);
    stage_ = Stage::RehearseProfile;
  }
}

bool Planner::nearly_singular() const noexcept {
  constexpr double kNear = 0.03;
  return least_volume_ < kNear * usual_volume_;
}

void Planner::rehearse() noexcept {
  const double time = rehearsal_.time();
  const bool timing = stage_ == Stage::RehearseTiming;
  const bool seen = rehearsal_.look(segment_, timing ? segment_.timing.at(time).place : profile_.at(time).position);
  if (timing && !seen) {
    segment_.timing = {};
    rehearse_profile();
  } else if (!seen || rehearsal_.done()) {
    end_rehearsal();
  }
}

// What was too fast is gone through once more, since what lies between two instants shows when it is slower.
void Planner::end_rehearsal() noexcept {
  const double slower = rehearsal_.factor();
  const bool sure = slower < kNearlyOne || ++rehearsals_ == kMostRehearsals;
  if (stage_ == Stage::RehearseProfile) {
    segment_.limits.velocity /= slower;
    segment_.limits.acceleration /= slower * slower;
    segment_.limits.jerk /= slower * slower * slower;
    if (sure) {
      stage_ = Stage::Done;
    } else {
      rehearse_profile();
    }
    return;
  }
  segment_.timing.slow_down(slower);
  segment_.timing_limits = rehearsal_.pace_limits();
  if (segment_.timing.duration() >= Profile::to_position({}, segment_.length, 0, segment_.limits).duration()) {
    segment_.timing = {};
    rehearse_profile();
  } else if (nearly_singular() && !sure) {
    rehearse_timing();
  } else {
    stage_ = Stage::Done;
  }
}

}  // namespace indurop::robot
