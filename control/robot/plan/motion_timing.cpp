// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/motion_timing.h"

#include <algorithm>

namespace indurop::robot {

namespace {

constexpr double kSlowestPace = 0.02;  // part of full speed below which a path counts as singular
constexpr double kNearlyOne = 1.02;
// Another search is worthwhile: slowing down everywhere costs time, and where the tool has a constant speed, that is
// lower than the one asked for.
constexpr int kMostSearches = 5;
constexpr double kExact = 1.001;  // the speed asked for, as far as more searches are worth their time
constexpr int kMostRehearsals = 3;
constexpr int kLastRehearsal = 16;  // of what may no longer be rejected for being slow
// Factor by which the motion is too fast in one place above which another search does not help.
constexpr double kHopeless = 35;
constexpr double kNotFound = 1.1;  // after all rehearsals: the critical place is too narrow to be resolved

}  // namespace

// A path that may be blended has one speed for all of it; if that is far too slow, it comes to rest at its end instead.
void MotionTiming::begin(double wanted) noexcept {
  searches_ = 1;
  rehearsals_ = 0;
  unseen_ = false;
  Segment& s = draft_.segment;
  if (s.limits.velocity < kSlowestPace * wanted) {
    s.zone = 0;
  }
  if (s.zone <= 0) {
    before_search_ = draft_.work.places();
    search_.begin(s, findings_.bounds());
    stage_ = Stage::Search;
  } else {
    rehearse_profile();
  }
}

void MotionTiming::work(int& places) noexcept {
  if (stage_ == Stage::Search) {
    places -= search();
  } else {
    --places;
    rehearse();
  }
}

int MotionTiming::search() noexcept {
  const bool looks = search_.looks();
  const int places = search_.work();
  if (looks) {
    draft_.work.add_on_path(places);
  } else {
    draft_.work.add(places);
  }
  if (!search_.done()) {
    return places;
  }
  const PathTiming& found = search_.timing();
  if (found.known()) {
    draft_.segment.timing = found;
    rehearse_timing();
  } else if (search_.too_coarse() && may_search_again()) {
    search_.refine();
  } else {
    rehearse_profile();
  }
  return places;
}

// Returns whether a finer search, which takes twice as much work, leaves enough of it to reject the motion soon. A path
// of the joints is not rejected any more.
bool MotionTiming::may_search_again() const noexcept {
  const int most = PlanningWork::kMaxRefusalWork / 2;
  return draft_.segment.joint_path != nullptr || !draft_.work.may_refuse() ||
         draft_.work.places() + 2 * (draft_.work.places() - before_search_) <= most;
}

void MotionTiming::rehearse_timing() noexcept {
  Segment& s = draft_.segment;
  if (is_too_slow(s.timing.duration())) {
    s.timing = {};
    rehearse_profile();
    return;
  }
  if (begin_rehearsal(s.timing.duration())) {
    stage_ = Stage::RehearseTiming;
    rehearsal_.begin_timing(begins_narrow());
  }
}

// If joint speeds change abruptly, the motion itself is checked, not only places on the path, also at constant
// speed.
void MotionTiming::rehearse_profile() noexcept {
  stage_ = Stage::Done;
  if (const Profile followed = profile(); rehearsal_.is_fine() && begin_rehearsal(followed.duration())) {
    stage_ = Stage::RehearseProfile;
    rehearsal_.begin_profile(followed, begins_narrow());
  }
}

// What is too slow already is rejected before it is rehearsed: it only becomes slower. Returns false then.
bool MotionTiming::begin_rehearsal(double duration) noexcept {
  if (is_too_slow(duration)) {
    unseen_ = true;
    stage_ = Stage::Done;
    return false;
  }
  most_factor_ = std::max(kNearlyOne, least() / (kSlowestPace * duration));
  return true;
}

// Returns whether a motion of that duration is rejected for being slow: soon, or else before a rehearsal that takes
// more work than any motion is worth.
bool MotionTiming::is_too_slow(double duration) const noexcept {
  return duration * kSlowestPace > least() &&
         (draft_.work.may_refuse() || !draft_.work.may_take(rehearsal_.instants(duration)));
}

void MotionTiming::rehearse() noexcept {
  const bool timing = stage_ == Stage::RehearseTiming;
  const bool may_search = timing && searches_ < kMostSearches;
  const bool seen = rehearsal_.check_next();
  const Rehearsal& result = rehearsal_.result();
  if (may_search && seen) {
    search_.note(rehearsal_.time(), result.last_factor());
  }
  const bool hopeless = result.factor() > (may_search ? kHopeless : most_factor_) && draft_.work.may_refuse();
  if (seen ? hopeless || result.jumped() || rehearsal_.steps() : !timing) {
    unseen_ = true;  // whatever the rest of it would show
    stage_ = Stage::Done;
  } else if (!seen) {
    draft_.segment.timing = {};
    rehearse_profile();
  } else if (!rehearsal_.advance()) {
    end_rehearsal();
  }
}

// A motion that was too fast is rehearsed again, since effects between two instants show when it is slower.
void MotionTiming::end_rehearsal() noexcept {
  const bool timing = stage_ == Stage::RehearseTiming;
  const double slower = rehearsal_.result().factor();
  const bool searches = slower > kNearlyOne ? slower <= kHopeless : slower > kExact && !crawls();
  if (timing && searches && searches_ < kMostSearches) {
    ++searches_;
    search_.refine();
    stage_ = Stage::Search;
    return;
  }
  const int most = draft_.work.may_refuse() || slower <= kNotFound ? kMostRehearsals : kLastRehearsal;
  const bool sure = slower < kNearlyOne || ++rehearsals_ >= most;
  unseen_ = sure && slower > kNotFound;
  if (timing) {
    end_timing(slower, sure);
  } else {
    end_profile(slower, sure);
  }
}

void MotionTiming::end_profile(double slower, bool sure) noexcept {
  LineLimits& limits = draft_.segment.limits;
  const PaceLimits& pace = rehearsal_.result().pace_limits();
  constexpr double kLeft = 1 - Shares::kBendingJerk - Shares::kMixedJerk;
  limits.velocity /= slower;
  limits.acceleration = std::min(
      limits.acceleration / (slower * slower),
      std::min((1 - Shares::kBending) * pace.acceleration, Shares::kMixedJerk / 3 * pace.mixed) * limits.velocity);
  limits.jerk = std::min(limits.jerk / (slower * slower * slower), kLeft * pace.jerk * limits.velocity);
  if (sure) {
    stage_ = Stage::Done;
  } else {
    rehearse_profile();
  }
}

void MotionTiming::end_timing(double slower, bool sure) noexcept {
  Segment& s = draft_.segment;
  s.timing.slow_down(slower);
  s.timing_tip_speed = rehearsal_.result().tip_speed() / slower;
  if (unseen_ || (draft_.work.may_refuse() && crawls())) {
    stage_ = Stage::Done;  // the result is rejected; another rehearsal could take long
    return;
  }
  s.pace_limits = rehearsal_.result().pace_limits();
  if (s.timing.duration() >= profile().duration()) {
    s.timing = {};
    rehearse_profile();
  } else if (!sure && rehearsal_.is_fine()) {
    rehearse_timing();
  } else {
    stage_ = Stage::Done;
  }
}

Fault MotionTiming::fault() const noexcept {
  if (const int axis = rehearsal_.result().restless_axis(); unseen_ && axis >= 0) {
    return {ErrorCode::JointLimit, axis + 1};
  }
  return {unseen_ || (draft_.work.may_refuse() && crawls()) ? ErrorCode::Singular : ErrorCode::Ok};
}

Profile MotionTiming::profile() const noexcept {
  return Profile::to_position({}, draft_.segment.length, 0, draft_.segment.limits);
}

// s, minimum duration as limited by the tool.
double MotionTiming::least() const noexcept {
  const Segment& s = draft_.segment;
  // The speed of a chain does not include a wave across it.
  return s.chain != nullptr ? std::max(s.chain->at_speed(), s.length / s.most.velocity)
                            : Profile::to_position({}, s.length, 0, s.most).duration();
}

// Returns whether the whole motion takes unacceptably longer than the tool's speed would allow. A singular position
// that is nearly met affects only a few places, so it shows in the rehearsal, or not at all, however slow the motion
// is.
bool MotionTiming::crawls() const noexcept {
  return draft_.segment.duration() * kSlowestPace > least();
}

}  // namespace indurop::robot
