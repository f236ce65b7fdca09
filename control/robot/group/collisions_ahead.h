// SPDX-License-Identifier: Apache-2.0
// Collision check for axes that move as single axes or follow others, and for arms that track a belt or are corrected
// by a sensor: their path was not planned, so in each period they must be able to come to rest before anything touches.

#pragma once

#include "control/robot/collision/collision_check.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class CollisionsAhead {
 public:
  explicit CollisionsAhead(const Robot& robot)
      : robot_(robot),
        clear_(robot.tool.places().clearance(), false),
        to_rest_(robot.tool.places().clearance(), false) {}

  // Checks the set points that are about to be sent. `off_path`: something moves them away from the planned path.
  // Errors: Collision. Real-time safe, like all functions of this class.
  Fault step(bool off_path) noexcept;
  // Returns whether step() would refuse these set points, as something moves them away from the planned path.
  [[nodiscard]] Fault foresee() noexcept;
  // Calls add(vector) for the memory that changes, see KeptImage.
  template <class Add>
  void blocks(const Add& add) {
    clear_.blocks(add);
    to_rest_.blocks(add);
  }
  // The bodies have been replaced by those of the program.
  void replace(Program& program) noexcept {
    clear_.swap(program.unplanned);
    to_rest_.swap(program.to_rest);
    begun_ = false;
  }

 private:
  [[nodiscard]] bool is_needed() const noexcept;
  [[nodiscard]] Fault check() noexcept;
  [[nodiscard]] Fault advance(CollisionCheck& way) const noexcept;
  [[nodiscard]] Fault rest(CollisionCheck& way) const noexcept;

  const Robot& robot_;
  CollisionCheck clear_, to_rest_;  // up to the last set point, and for a way to rest
  bool begun_ = false;
};

}  // namespace indurop::robot
