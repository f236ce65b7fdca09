// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/motion_rehearsal.h"

#include <algorithm>

namespace indurop::robot {

namespace {

constexpr double kInstantStep = 0.002;      // s between checked instants of a motion
constexpr double kFineInstantStep = 0.001;  // s
constexpr int kAround = 100;                // instants before and after a narrow place
constexpr int kBackwards = 5;               // instants of one step from there to the first one
constexpr int kShort = 2000;                // instants of a motion that is rehearsed as a whole at once

}  // namespace

bool MotionRehearsal::is_fine() const noexcept {
  return draft_.segment.chain != nullptr || draft_.segment.joint_path != nullptr || draft_.segment.wave.on() ||
         draft_.work.settles_slowly() || findings_.nearly_singular() || findings_.turns_at_end();
}

// s between two instants, at most.
double MotionRehearsal::step() const noexcept {
  return is_fine() ? kFineInstantStep : kInstantStep;
}

void MotionRehearsal::begin_timing(bool narrow_first) noexcept {
  timed_ = true;
  stretches_ = narrow_first ? findings_.narrow().size() + 1 : 1;
  next_stretch(draft_.segment.timing.duration());
}

void MotionRehearsal::begin_profile(const Profile& profile, bool narrow_first) noexcept {
  timed_ = false;
  profile_ = profile;
  stretches_ = narrow_first ? findings_.narrow().size() + 1 : 1;
  next_stretch(profile_.duration());
}

double MotionRehearsal::place_at(double time) const noexcept {
  return timed_ ? draft_.segment.timing.at(time).place : profile_.at(time).position;
}

bool MotionRehearsal::check_next() noexcept {
  draft_.work.add_on_path(1);
  if (const double far = rehearsal_.far_time(); far >= 0 && !draft_.segment.wave.on()) {
    draft_.work.add_on_path(1);
    rehearsal_.skip(draft_.segment, place_at(far));
  }
  time_ = rehearsal_.time();
  return rehearsal_.look(draft_.segment, place_at(time_));
}

bool MotionRehearsal::steps() noexcept {
  int places = 0;
  const bool found = rehearsal_.steps(draft_.segment, places);
  draft_.work.add_on_path(places);
  return found;
}

bool MotionRehearsal::advance() noexcept {
  if (!rehearsal_.done()) {
    return true;
  }
  if (stretches_ == 0) {
    return false;
  }
  next_stretch(rehearsal_.step() * rehearsal_.count());
  return true;
}

// The last instant that is not behind the place.
int MotionRehearsal::instant_of(double place) const noexcept {
  int low = 0;
  for (int high = rehearsal_.count(); high - low > 1;) {
    const int middle = low + (high - low) / 2;
    int& bound = place_at(rehearsal_.step() * middle) <= place ? low : high;
    bound = middle;
  }
  return low;
}

// Returns whether there is such a stretch. It goes backwards to its first instant, in the same posture.
bool MotionRehearsal::begin_stretch(const NarrowPlace& narrow) noexcept {
  constexpr double kSure = radians(30);
  const int middle = instant_of(narrow.place);
  const int first = std::max(0, middle - kAround);
  Joints q = narrow.joints;
  for (int i = middle; i > first;) {
    i = std::max(first, i - kBackwards);
    draft_.work.add_on_path(1);
    const Joints before = q;
    if (places_.on(draft_.segment, place_at(rehearsal_.step() * i), before, q) != Reach::Ok ||
        (q - before).cwiseAbs().maxCoeff() > kSure) {
      return false;
    }
  }
  rehearsal_.begin_stretch(q, place_at(rehearsal_.step() * first), first,
                           std::min(middle + kAround, rehearsal_.count()) - first);
  return true;
}

// Begins to rehearse the next narrow place or, after all of them, the whole motion.
void MotionRehearsal::next_stretch(double duration) noexcept {
  rehearsal_.begin(draft_.segment.from, duration, step(), timed_);
  while (--stretches_ > 0 && rehearsal_.count() > kShort) {
    if (begin_stretch(findings_.narrow()[stretches_ - 1])) {
      return;
    }
  }
  stretches_ = 0;
}

}  // namespace indurop::robot
