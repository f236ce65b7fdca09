// SPDX-License-Identifier: Apache-2.0
// Axes that belong to no group (<single_axes> of the URDF): they move whatever the group does, fail one by one, and may
// follow the tool. The numbers of their drives come after those of the arm.

#pragma once

#include <indurop/robot/controller.h>

#include <array>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

struct Robot;

class SingleAxes {
 public:
  explicit SingleAxes(Robot& robot) noexcept : robot_(robot) { hardness_.fill(1); }

  // Takes the drives' status; an emergency stop stops all of them. Real-time safe, like all functions of this class.
  void sense(const Inputs& in) noexcept;
  // Takes requests. `permit`: Ok, or why no motion is permitted.
  void serve(const Inputs& in, ErrorCode permit) noexcept;
  // Continues their motions by one period, once the set points of the arm are known. Every set point passes through the
  // gate of its axis, which brakes on its own if it rejects one. `path_follows`: a path follows a master.
  void step(const Inputs& in, Outputs& out, bool path_follows) noexcept;
  void report(Outputs& out) const noexcept;
  // Comes to rest, since the operating mode demands it.
  void halt() noexcept;

 private:
  [[nodiscard]] std::size_t drive(int i) const noexcept;
  [[nodiscard]] ErrorCode stop_of_all(bool emergency) const noexcept;
  void measure_travel(bool path_follows) noexcept;
  void fail_all(ErrorCode code) noexcept;
  void pass(int i) noexcept;

  Robot& robot_;
  std::array<bool, kAxes> braking_{};     // by its gate
  std::array<bool, kAxes> quick_stop_{};  // it loses its power once it rests
  std::array<double, kAxes> hardness_{};  // factor on its acceleration while it stops
};

}  // namespace indurop::robot
