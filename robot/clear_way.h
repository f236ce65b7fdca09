// SPDX-License-Identifier: Apache-2.0
// A way of the arm that is looked at step by step, and nothing is missed between the steps: no body can have moved
// farther than its axes let it, and two bodies that are farther apart than that did not meet.

#pragma once

#include <memory>
#include <vector>

#include "robot/clearance.h"
#include "robot/nearest.h"

namespace indurop::robot {

class ClearWay {
 public:
  // `exact`: as near as FCL can tell, not for the tick; else two bodies may count as touching that nearly do.
  ClearWay(const Clearance& clearance, bool exact);

  enum class Step {
    Clear,
    Shorter,  // it cannot be said for all of the step: try a shorter one
    Touches,  // pair() come too near to each other
    Lost      // the way does not go on
  };
  // Where a way begins. Real-time safe as all the rest, if it is not exact.
  void begin(const Joints& from, int tool) noexcept;
  // Another one's bodies, and that one has these. clearance() has to follow.
  void swap(ClearWay& other) noexcept;
  // Goes on where `other` is, which looks at the same bodies.
  void take(const ClearWay& other) noexcept;
  // On to `to`; the axes go `moved` on that step, there and back. What is too near already may not come nearer.
  Step next(const Joints& to, const Joints& moved) noexcept;
  // Where the last step led to.
  [[nodiscard]] const Joints& at() const noexcept { return at_; }
  // Of what touches, where it begins or on the last step; -1: nothing did.
  [[nodiscard]] int pair() const noexcept { return pair_; }

 private:
  // How far a pair is from touching, at least, at the last step.
  struct Room {
    double left = 0;      // m
    bool counts = false;  // with this tool
    bool inside = false;  // it touches, and may only come apart
  };

  // m from touching, at one of the two places.
  [[nodiscard]] double measure(std::size_t pair, const Clearance::Places& places) noexcept;
  Step look(std::size_t pair, double most, bool& placed, const Joints& to) noexcept;
  Step come_apart(std::size_t pair, double most) noexcept;

  const Clearance& clearance_;
  std::unique_ptr<Nearest> nearest_;
  std::vector<Room> rooms_, next_;
  Clearance::Places here_, there_;
  Joints at_ = Joints::Zero();
  bool here_placed_ = false;
  int pair_ = -1;
  double apart_ = 0;  // m, the longest step of what touches
};

// How far axes go on a way of which three places are known, the second in its middle: twice what a smooth way takes.
[[nodiscard]] Joints moved_by(const Joints& from, const Joints& middle, const Joints& to) noexcept;

// Along a way from place 0 on, in steps as long as can be.
class ClearWalk {
 public:
  // `widest`: the longest step whose middle shows how the way bends.
  void begin(double length, double widest) noexcept {
    length_ = length;
    width_ = widest_ = widest;
    place_ = 0;
  }
  [[nodiscard]] bool done() const noexcept { return !(place_ < length_); }
  [[nodiscard]] double place() const noexcept { return place_; }
  // One step on, or none if it has to be shorter. `at(place, near, q)`: where the axes are; false if nowhere.
  template <class At>
  ClearWay::Step step(ClearWay& way, const At& at) noexcept {
    if (width_ < 1e-9 * length_) {
      return ClearWay::Step::Lost;
    }
    const double to = place_ + 1.001 * width_ >= length_ ? length_ : place_ + width_;
    Joints middle = way.at();
    if (!at((place_ + to) / 2, way.at(), middle)) {
      return ClearWay::Step::Lost;
    }
    Joints end = middle;
    if (!at(to, middle, end)) {
      return ClearWay::Step::Lost;
    }
    const ClearWay::Step step = way.next(end, moved_by(way.at(), middle, end));
    if (step == ClearWay::Step::Clear) {
      place_ = to;
      width_ = 2 * width_ < widest_ ? 2 * width_ : widest_;
    } else {
      width_ /= 2;
    }
    return step;
  }

  // All of it, if that is not too long to be shown in so many steps. Else pair() is what is in the way.
  template <class At>
  bool all(ClearWay& way, int steps, const At& at) noexcept {
    for (; steps > 0 && !done(); --steps) {
      const ClearWay::Step one = step(way, at);
      if (one == ClearWay::Step::Touches || one == ClearWay::Step::Lost) {
        return false;
      }
    }
    return done();
  }

 private:
  double length_ = 0, place_ = 0, width_ = 0, widest_ = 0;
};

}  // namespace indurop::robot
