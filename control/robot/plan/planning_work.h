// SPDX-License-Identifier: Apache-2.0
// How much work the planning of one motion has taken: counted in places, so that it is the same on every machine.

#pragma once

namespace indurop::robot {

// All functions are real-time safe.
class PlanningWork {
 public:
  // Work after which no motion is rejected for being slow, nor for torques of its movement, if it can be planned to its
  // end. In places in closed form, of which each takes 15 000 instructions at most.
  static constexpr int kMaxRefusalWork = 12000;
  // Work for a motion that is too slow to be accepted sooner: what takes more is rejected before it is done.
  static constexpr int kMaxSlowWork = 1'000'000;

  // Begins with none. `closed_form`: whether the arm's inverse kinematics are.
  void begin(bool closed_form) noexcept {
    places_ = 0;
    weight_ = closed_form ? 1 : kStepByStep;
  }
  // Adds work that takes as long as this many places in closed form.
  void add(int places) noexcept { places_ += places; }
  // Adds places on the path, of which each may count as several.
  void add_on_path(int places) noexcept { places_ += places * weight_; }
  // Records that an orientation is missed on the path.
  void settle_slowly() noexcept { weight_ = kSettlesSlowly; }
  [[nodiscard]] bool settles_slowly() const noexcept { return weight_ == kSettlesSlowly; }
  // Work so far, in places in closed form.
  [[nodiscard]] int places() const noexcept { return places_; }
  // Afterwards a motion is rejected only for collisions, for work beyond kMaxSlowWork, and for what only the whole
  // rehearsal or check of torques finds in a place.
  [[nodiscard]] bool may_refuse() const noexcept { return places_ <= kMaxRefusalWork; }
  // Returns whether a slow motion may take this many more places on its path.
  [[nodiscard]] bool may_take(double places) const noexcept { return places_ + weight_ * places <= kMaxSlowWork; }

 private:
  // What a place takes by iteration, in places in closed form: if the pose is reached, and if its orientation is missed
  // on the path. The closest orientation may change as fast as joints near a singular position.
  static constexpr int kStepByStep = 4, kSettlesSlowly = 5;

  int places_ = 0;
  int weight_ = 1;
};

}  // namespace indurop::robot
