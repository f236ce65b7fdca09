// SPDX-License-Identifier: Apache-2.0
// Checks a path of the arm step by step without missing anything between the steps: no body can have moved farther than
// its axes allow, and two bodies that are farther apart than that did not meet.

#pragma once

#include <memory>
#include <vector>

#include "control/robot/collision/body_distance.h"
#include "control/robot/collision/clearance.h"

namespace indurop::robot {

class CollisionCheck {
 public:
  // `exact`: as exact as FCL can compute, not for the tick; otherwise two bodies may count as touching that only nearly
  // do.
  CollisionCheck(const Clearance& clearance, bool exact);

  enum class Step {
    Clear,
    Shorter,  // undecided for the whole step: try a shorter one
    Touches,  // the bodies of pair() come too near to each other
    Lost      // the path cannot be continued
  };
  // Sets the start of a path, whose bodies must keep `more` m in addition to the margin. Real-time safe like all
  // functions below, unless it is exact.
  void begin(const Joints& from, int tool, double more = 0) noexcept;
  // Exchanges the bodies with those of another one. clearance() has to follow.
  void swap(CollisionCheck& other) noexcept;
  // Continues from the present place of `other`, which checks the same bodies.
  void take(const CollisionCheck& other) noexcept;
  // Checks the step to `to`; `moved` is the distance that the axes travel in it, back and forth. Bodies that are
  // already too near may not come nearer.
  Step next(const Joints& to, const Joints& moved) noexcept;
  // Calls add(vector) for the memory that changes, see KeptImage.
  template <class Add>
  void blocks(const Add& add) {
    add(rooms_);
    add(next_);
    add(here_);
    add(there_);
  }
  // Returns where the last step led to.
  [[nodiscard]] const Joints& at() const noexcept { return at_; }
  // Returns the pair that touches, at the start or on the last step; -1: none did.
  [[nodiscard]] int pair() const noexcept { return pair_; }

 private:
  // Minimum distance of a pair from touching, at the last step.
  struct Room {
    double left = 0;      // m
    bool counts = false;  // applies to this tool
    bool inside = false;  // it touches, and may only separate
  };

  // Returns the distance from touching at one of the two places, in m.
  [[nodiscard]] double measure(std::size_t pair, const Clearance::Places& places) noexcept;
  // A lower bound of it, without FCL.
  [[nodiscard]] double least(std::size_t pair, const Clearance::Places& places) const noexcept {
    return clearance_.least(clearance_.pairs()[pair], places) - more_;
  }
  Step look(std::size_t pair, double most, bool& placed, const Joints& to) noexcept;
  Step come_apart(std::size_t pair, double most) noexcept;

  const Clearance& clearance_;
  std::unique_ptr<Nearest> nearest_;
  std::vector<Room> rooms_, next_;
  Clearance::Places here_, there_;
  Joints at_ = Joints::Zero();
  bool here_placed_ = false;
  int pair_ = -1;
  double apart_ = 0;  // m, the longest step while bodies touch
  double more_ = 0;   // m, in addition to the margin
};

// Returns how far axes travel at most on a path of which three places are known, the second in its middle; with twice
// the allowance that a smooth path needs.
[[nodiscard]] Joints moved_by(const Joints& from, const Joints& middle, const Joints& to) noexcept;

// Walks along a path from place 0 on, in steps as long as possible.
class ClearWalk {
 public:
  // `widest`: the longest step in which the middle still shows how the path bends.
  void begin(double length, double widest) noexcept {
    length_ = length;
    width_ = widest_ = widest;
    place_ = 0;
  }
  [[nodiscard]] bool done() const noexcept { return !(place_ < length_); }
  [[nodiscard]] double place() const noexcept { return place_; }
  // Takes one step, or none if it has to be shorter. `at(place, near, q)`: the axes at a place; false if there are
  // none. `way`: a CollisionCheck, or another class with at() and next().
  template <class Way, class At>
  CollisionCheck::Step step(Way& way, const At& at) noexcept {
    if (is_lost()) {
      return CollisionCheck::Step::Lost;
    }
    const double to = next_place();
    Joints middle = way.at();
    if (!at((place_ + to) / 2, way.at(), middle)) {
      return CollisionCheck::Step::Lost;
    }
    Joints end = middle;
    if (!at(to, middle, end)) {
      return CollisionCheck::Step::Lost;
    }
    return note(way.next(end, moved_by(way.at(), middle, end)), to);
  }
  // The same on a path whose joints are known at each place, `at(place)`, and so is how far they travel between two,
  // `travel(from, to)`.
  template <class Way, class At, class Travel>
  CollisionCheck::Step step_along(Way& way, const At& at, const Travel& travel) noexcept {
    if (is_lost()) {
      return CollisionCheck::Step::Lost;
    }
    const double to = next_place();
    return note(way.next(at(to), travel(place_, to)), to);
  }

  // Takes the whole path, if `steps` steps are enough for it. Otherwise pair() returns what is in the way.
  template <class At>
  bool all(CollisionCheck& way, int steps, const At& at) noexcept {
    for (; steps > 0 && !done(); --steps) {
      const CollisionCheck::Step one = step(way, at);
      if (one == CollisionCheck::Step::Touches || one == CollisionCheck::Step::Lost) {
        return false;
      }
    }
    return done();
  }

 private:
  [[nodiscard]] bool is_lost() const noexcept { return width_ < 1e-9 * length_; }
  [[nodiscard]] double next_place() const noexcept {
    return place_ + 1.001 * width_ >= length_ ? length_ : place_ + width_;
  }
  CollisionCheck::Step note(CollisionCheck::Step step, double to) noexcept {
    if (step == CollisionCheck::Step::Clear) {
      place_ = to;
      width_ = 2 * width_ < widest_ ? 2 * width_ : widest_;
    } else {
      width_ /= 2;
    }
    return step;
  }

  double length_ = 0, place_ = 0, width_ = 0, widest_ = 0;
};

}  // namespace indurop::robot
