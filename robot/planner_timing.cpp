// SPDX-License-Identifier: Apache-2.0
// What comes behind the look at a path: its timing, and a rehearsal of the motion.

#include <algorithm>

#include "robot/planner.h"

namespace indurop::robot {

namespace {

constexpr double kStep = 0.002;      // s between instants of a motion that are looked at
constexpr double kFineStep = 0.001;  // of chains, whose corners may be narrow, and near singular positions
constexpr double kNearlyOne = 1.02;
constexpr int kMostSearches = 3;  // what is lost by going slower everywhere is worth another one
constexpr int kMostRehearsals = 6;
constexpr double kNotFound = 1.1;  // after all of them: what happens there is too narrow to be seen

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
  rehearsal_.begin(segment_.from, segment_.timing.duration(), rehearsal_step(), true);
  stage_ = Stage::RehearseTiming;
}

// Where joint speeds change abruptly, not only the places but the motion itself is looked at, at one speed too.
void Planner::rehearse_profile() noexcept {
  profile_ = Profile::to_position({}, segment_.length, 0, segment_.limits);
  if (rehearsal_step() < kStep) {
    rehearsal_.begin(segment_.from, profile_.duration(), rehearsal_step(), false);
    stage_ = Stage::RehearseProfile;
  } else {
    end_look();
  }
}

double Planner::rehearsal_step() const noexcept {
  constexpr double kNear = 0.1;
  return segment_.chain != nullptr || least_volume_ < kNear * usual_volume_ ? kFineStep : kStep;
}

void Planner::rehearse() noexcept {
  const double time = rehearsal_.time();
  const bool timing = stage_ == Stage::RehearseTiming;
  const bool seen = rehearsal_.look(segment_, timing ? segment_.timing.at(time).place : profile_.at(time).position);
  if (timing && seen && searches_ < kMostSearches) {
    search_.note(time, rehearsal_.last_factor());
  }
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
  if (stage_ == Stage::RehearseTiming && slower > kNearlyOne && searches_ < kMostSearches) {
    ++searches_;
    search_.refine();
    stage_ = Stage::Search;
    return;
  }
  const bool sure = slower < kNearlyOne || ++rehearsals_ == kMostRehearsals;
  unseen_ = sure && slower > kNotFound;
  if (stage_ == Stage::RehearseProfile) {
    LineLimits& limits = segment_.limits;
    const PaceLimits& pace = rehearsal_.pace_limits();
    constexpr double kLeft = 1 - Shares::kBendingJerk - Shares::kMixedJerk;
    limits.velocity /= slower;
    limits.acceleration = std::min(
        limits.acceleration / (slower * slower),
        std::min((1 - Shares::kBending) * pace.acceleration, Shares::kMixedJerk / 3 * pace.mixed) * limits.velocity);
    limits.jerk = std::min(limits.jerk / (slower * slower * slower), kLeft * pace.jerk * limits.velocity);
    if (sure) {
      end_look();
    } else {
      rehearse_profile();
    }
    return;
  }
  segment_.timing.slow_down(slower);
  segment_.timing_tip_speed = rehearsal_.tip_speed() / slower;
  if (crawls()) {
    end_look();  // what comes of it is refused; going through it once more may take long
    return;
  }
  segment_.pace_limits = rehearsal_.pace_limits();
  if (segment_.timing.duration() >= Profile::to_position({}, segment_.length, 0, segment_.limits).duration()) {
    segment_.timing = {};
    rehearse_profile();
  } else if (!sure && rehearsal_step() < kStep) {
    rehearse_timing();
  } else {
    end_look();
  }
}

void Planner::end_look() noexcept {
  effort_.begin(segment_);
  stage_ = effort_.done() ? Stage::Done : Stage::Effort;
}

// Whether all of it takes so much longer than it would by the tool's speed that nobody waits for it: what is seen in
// places only, a singular position that is nearly met, shows in the rehearsal; or does not, however slow it is.
bool Planner::crawls() const noexcept {
  if (unseen_) {
    return true;
  }
  const Segment& s = segment_;
  const double least =
      s.chain != nullptr ? s.chain->at_speed() : Profile::to_position({}, s.length, 0, s.most).duration();
  const double taken =
      s.timing.known() ? s.timing.duration() : Profile::to_position({}, s.length, 0, s.limits).duration();
  return taken * kSlowestPace > least;
}

}  // namespace indurop::robot
