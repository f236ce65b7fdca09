// SPDX-License-Identifier: Apache-2.0
// A sheet that is not flat, with a ledge at its far side, under the tool of the arm: both push back as springs with
// damping do, and the sheet rubs. What the tool presses with is what a force sensor at the wrist measures, which
// compensates the weight of the tool.
#pragma once

#include <arm_tip.h>

#include <array>
#include <cstdint>
#include <string>

class Sheet {
 public:
  Sheet() = default;
  // Reads the property: height (mm), how far its waves rise and fall (mm), their length along y (mm), x of the ledge
  // (mm), stiffness of sheet and of ledge (N/mm). Empty: there is none. Throws what is wrong with it.
  explicit Sheet(const std::string& property);

  // Called once per period (s), with where the tip is. Returns the force on the arm and its moment about the arm's end,
  // along the axes of the base: N and N m.
  std::array<double, 6> push(const Tip& tip, double period);
  // N along x, y and z of the tool with which it presses, as the sensor measures it.
  [[nodiscard]] const std::array<double, 3>& measured() const { return measured_; }

 private:
  double noise();

  double height_ = 0, waves_ = 0, length_ = 1, ledge_ = 0, stiffness_ = 0, ledge_stiffness_ = 0;
  bool known_ = false;
  Tip before_;
  std::array<double, 3> measured_{};
  std::uint32_t random_ = 1;
};
