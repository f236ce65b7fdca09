// SPDX-License-Identifier: Apache-2.0
// Long motions are rehearsed where their path is narrow before they are rehearsed as a whole, so that what has to be
// rejected is rejected early.

#include <algorithm>
#include <cmath>

#include "control/robot/plan/planner.h"

namespace indurop::robot {

namespace {

constexpr int kAround = 100;   // instants before and after a narrow place
constexpr int kBackwards = 5;  // instants of one step from there to the first one
constexpr int kShort = 2000;   // instants of a motion that is rehearsed as a whole at once

}  // namespace

double Planner::place_at(double time) const noexcept {
  return stage_ == Stage::RehearseTiming ? segment_.timing.at(time).place : profile_.at(time).position;
}

// The last instant that is not behind the place.
int Planner::instant_of(double place) const noexcept {
  int low = 0;
  for (int high = rehearsal_.count(); high - low > 1;) {
    const int middle = low + (high - low) / 2;
    int& bound = place_at(rehearsal_.step() * middle) <= place ? low : high;
    bound = middle;
  }
  return low;
}

// Returns whether there is such a stretch. It goes backwards to its first instant, in the same posture.
bool Planner::begin_stretch(double place, const Joints& there) noexcept {
  constexpr double kSure = radians(30);
  const int middle = instant_of(place);
  const int first = std::max(0, middle - kAround);
  Joints q = there;
  for (int i = middle; i > first;) {
    i = std::max(first, i - kBackwards);
    work_ += weight_;
    const Joints before = q;
    if (places_.on(segment_, place_at(rehearsal_.step() * i), before, q) != Reach::Ok ||
        (q - before).cwiseAbs().maxCoeff() > kSure) {
      return false;
    }
  }
  rehearsal_.begin_stretch(q, first, std::min(middle + kAround, rehearsal_.count()) - first);
  return true;
}

// Begins to rehearse the next narrow place or, after all of them, the whole motion.
void Planner::next_stretch(double duration) noexcept {
  rehearsal_.begin(segment_.from, duration, rehearsal_step(), stage_ == Stage::RehearseTiming);
  while (--stretches_ > 0 && rehearsal_.count() > kShort) {
    const Narrow& narrow = narrow_[stretches_ - 1];
    if (begin_stretch(narrow.place, narrow.joints)) {
      return;
    }
  }
  stretches_ = 0;
}

}  // namespace indurop::robot
