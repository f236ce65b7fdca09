// SPDX-License-Identifier: Apache-2.0
// Converts commands of a single axis into motions, from where it is, within its limits and ends. Changes nothing.

#pragma once

#include <indurop/robot/commands.h>

#include "control/robot/axis/body.h"
#include "control/robot/axis/order.h"
#include "control/robot/kinematics/errors.h"
#include "control/robot/path/time_profile.h"

namespace indurop::robot {

class CommandResolver {
 public:
  // `parts` must outlive it.
  explicit CommandResolver(const AxisParts& parts) noexcept : parts_(parts) {}

  // Resolves a command for a motion that begins at `from`. Real-time safe, like all functions of this class.
  [[nodiscard]] ErrorCode resolve(const Command& command, double from, AxisOrder& order) const noexcept;
  // The same, and checks its way if it begins now.
  [[nodiscard]] ErrorCode resolve_whole(const Command& command, double from, AxisOrder& order) const noexcept;
  // Checks that a motion can rest between the ends wherever it has to.
  [[nodiscard]] ErrorCode check_way(const Command& command, const AxisOrder& order) const noexcept;
  // Resolves how to follow other axes (follow_resolver.cpp).
  [[nodiscard]] ErrorCode follow(const Command& command, const AxisOrder& order, AxisFollow& way) const noexcept;
  // Reads a time table that begins at the present state of the axis (profile_resolver.cpp).
  ErrorCode read_table(const Command& command, TimeProfile& table) const noexcept;

 private:
  [[nodiscard]] double turned(double target, double from, Direction direction) const noexcept;
  [[nodiscard]] ErrorCode limit(const Command& command, AxisOrder& order) const noexcept;
  [[nodiscard]] ErrorCode target(const Command& command, double from, AxisOrder& order) const noexcept;
  [[nodiscard]] ErrorCode check_profile(const Command& command) const noexcept;
  [[nodiscard]] bool follows_itself(const AxisFollow& way) const noexcept;
  [[nodiscard]] ErrorCode of_tool(const Command& command, AxisFollow& way) const noexcept;
  [[nodiscard]] ErrorCode ratios(const Command& command, AxisFollow& way) const noexcept;
  [[nodiscard]] ErrorCode meeting(const Command& command, const AxisOrder& order, AxisFollow& way) const noexcept;
  [[nodiscard]] ErrorCode cam(const Command& command, const AxisControl& master, CouplingLaw& law) const noexcept;

  const AxisParts& parts_;
};

}  // namespace indurop::robot
