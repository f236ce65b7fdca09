// SPDX-License-Identifier: Apache-2.0
// Where the elbow of an arm with more than six axes goes on a line, a circle or a chain: it stays if the axes keep away
// from their limits; otherwise it moves uniformly along the path to the nearest angle at which they do.

#pragma once

#include "control/robot/plan/draft.h"

namespace indurop::robot {

// Depends only on where the joints are and on the path, not on speeds that change later: the same path always gets the
// same elbow. All functions are real-time safe.
class ElbowChoice {
 public:
  // Both are borrowed.
  ElbowChoice(const Places& places, Draft& draft) noexcept;

  // There is no path to choose for.
  void reset() noexcept { searching_ = moved_ = false; }
  // Begins with the draft's path. It is done() at once if there is no elbow that may move, or if the command moves it.
  void begin() noexcept;
  // Tries a few more angles and subtracts the places that it checked.
  void check(int& places) noexcept;
  [[nodiscard]] bool done() const noexcept { return !searching_; }
  // The rest of the planning has rejected the path. Returns whether the elbow was moved by choice and could also stay:
  // the draft's path is then that one.
  bool give_up() noexcept;

 private:
  static constexpr int kPlaces = 24;  // of the path that are checked

  void try_angle(double angle) noexcept;
  [[nodiscard]] double walk(double angle) noexcept;
  void finish() noexcept;
  void move_to(double angle) noexcept;

  const Places& places_;
  Draft& draft_;
  int axis_ = -1;        // that moves the elbow; -1: none does
  double rooms_ = 0;     // rad, room_of() at the start
  double farthest_ = 0;  // rad that the elbow may move without making the path slow
  double held_ = 0;      // how good it is to stay, as walk() returns it
  double best_ = 0;      // the same of the best angle so far
  double chosen_ = 0;    // that angle
  int next_ = 0;         // number of the next angle
  bool searching_ = false;
  bool moved_ = false;
  Segment staying_;  // the path if the elbow stays
};

}  // namespace indurop::robot
