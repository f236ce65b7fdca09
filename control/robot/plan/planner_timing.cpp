// SPDX-License-Identifier: Apache-2.0
// The stages after the check of a path: its timing, and a rehearsal of the motion.

#include <algorithm>

#include "control/robot/plan/planner.h"

namespace indurop::robot {

namespace {

constexpr double kStep = 0.002;  // s between checked instants of a motion
// s, for chains, whose corners may be narrow, near singular positions, and where an orientation is missed
constexpr double kFineStep = 0.001;
constexpr double kNearlyOne = 1.02;
constexpr int kMostSearches = 3;  // another search is worthwhile, since slowing down everywhere costs time
constexpr int kMostRehearsals = 3;
constexpr int kLastRehearsal = 16;  // of what may no longer be rejected for being slow
// Factor by which the motion is too fast in one place above which another search does not help.
constexpr double kHopeless = 35;
constexpr double kNotFound = 1.1;  // after all rehearsals: the critical place is too narrow to be resolved

}  // namespace

int Planner::search() noexcept {
  const int weight = search_.looks() ? weight_ : 1;
  const int places = search_.work();
  work_ += places * weight;
  if (!search_.done()) {
    return places;
  }
  const PathTiming& found = search_.timing();
  if (found.known()) {
    segment_.timing = found;
    rehearse_timing();
  } else {
    rehearse_profile();
  }
  return places;
}

void Planner::rehearse_timing() noexcept {
  if (may_refuse() && segment_.timing.duration() * kSlowestPace > least()) {
    segment_.timing = {};
    rehearse_profile();
    return;
  }
  stage_ = Stage::RehearseTiming;
  begin_rehearsal(segment_.timing.duration());
}

// If joint speeds change abruptly, the motion itself is checked, not only places on the path, also at constant
// speed.
void Planner::rehearse_profile() noexcept {
  profile_ = Profile::to_position({}, segment_.length, 0, segment_.limits);
  if (rehearsal_step() < kStep) {
    stage_ = Stage::RehearseProfile;
    begin_rehearsal(profile_.duration());
  } else {
    end_look();
  }
}

// What is too slow already is rejected before it is rehearsed: it only becomes slower.
void Planner::begin_rehearsal(double duration) noexcept {
  if (may_refuse() && duration * kSlowestPace > least()) {
    unseen_ = true;
    stage_ = Stage::Done;
    return;
  }
  most_factor_ = std::max(kNearlyOne, least() / (kSlowestPace * duration));
  stretches_ = searches_ == 1 && rehearsals_ == 0 ? kNarrow + 1 : 1;
  next_stretch(duration);
}

double Planner::rehearsal_step() const noexcept {
  constexpr double kNear = 0.1;
  return segment_.chain != nullptr || weight_ == kSettlesSlowly || least_volume_ < kNear * usual_volume_ ? kFineStep
                                                                                                         : kStep;
}

void Planner::rehearse() noexcept {
  const bool timing = stage_ == Stage::RehearseTiming;
  if (const double far = rehearsal_.far_time(); far >= 0) {
    work_ += weight_;
    rehearsal_.skip(segment_, place_at(far));
  }
  const double time = rehearsal_.time();
  const bool seen = rehearsal_.look(segment_, place_at(time));
  if (timing && seen && searches_ < kMostSearches) {
    search_.note(time, rehearsal_.last_factor());
  }
  const bool hopeless =
      rehearsal_.factor() > (timing && searches_ < kMostSearches ? kHopeless : most_factor_) && may_refuse();
  if (seen ? hopeless || rehearsal_.jumped() : !timing) {
    unseen_ = true;  // whatever the rest of it would show
    stage_ = Stage::Done;
  } else if (!seen) {
    segment_.timing = {};
    rehearse_profile();
  } else if (rehearsal_.done()) {
    if (stretches_ > 0) {
      next_stretch(rehearsal_.step() * rehearsal_.count());
    } else {
      end_rehearsal();
    }
  }
}

// A motion that was too fast is rehearsed again, since effects between two instants show when it is slower.
void Planner::end_rehearsal() noexcept {
  const double slower = rehearsal_.factor();
  if (stage_ == Stage::RehearseTiming && slower > kNearlyOne && slower <= kHopeless && searches_ < kMostSearches) {
    ++searches_;
    search_.refine();
    stage_ = Stage::Search;
    return;
  }
  const int most = may_refuse() || slower <= kNotFound ? kMostRehearsals : kLastRehearsal;
  const bool sure = slower < kNearlyOne || ++rehearsals_ >= most;
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
  if (unseen_ || (may_refuse() && crawls())) {
    end_look();  // the result is rejected; another rehearsal could take long
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

double Planner::least() const noexcept {
  const Segment& s = segment_;
  return s.chain != nullptr ? s.chain->at_speed() : Profile::to_position({}, s.length, 0, s.most).duration();
}

double Planner::taken() const noexcept {
  const Segment& s = segment_;
  return s.timing.known() ? s.timing.duration() : Profile::to_position({}, s.length, 0, s.limits).duration();
}

// Returns whether the whole motion takes unacceptably longer than the tool's speed would allow. A singular position
// that is nearly met affects only a few places, so it shows in the rehearsal, or not at all, however slow the motion
// is.
bool Planner::crawls() const noexcept {
  return taken() * kSlowestPace > least();
}

}  // namespace indurop::robot
