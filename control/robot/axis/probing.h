// SPDX-License-Identifier: Apache-2.0
// The commands of an axis' touch probe: one waits for an edge, also within a window, another one ends it.

#pragma once

#include <indurop/robot/commands.h>

#include "control/robot/axis/answers.h"
#include "control/robot/axis/probe.h"
#include "control/robot/axis/units.h"

namespace indurop::robot {

class Probing {
 public:
  explicit Probing(AxisAnswers& answers) noexcept : answers_(answers) {}

  // Permitted in any state: an axis turned by hand may be probed as well. Real-time safe, like all functions of this
  // class.
  void begin(int ticket, const Command& command) noexcept;
  void abort(int ticket) noexcept;
  void sense(const DriveIn& in, const AxisUnits& units) noexcept;
  [[nodiscard]] std::uint16_t function() const noexcept { return probe_.function(); }

 private:
  AxisAnswers& answers_;
  AxisOwner owner_;
  AxisProbe probe_;
  bool windowed_ = false;
  double first_ = 0, last_ = 0;  // in units of its users
};

}  // namespace indurop::robot
