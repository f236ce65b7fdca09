// SPDX-License-Identifier: Apache-2.0
// Groups of the services of a single axis.

#pragma once

#include <indurop/robot/commands.h>
#include <indurop/robot/controller.h>

namespace indurop::robot {

inline AxisService axis_service_of(const Command& command) noexcept {
  return static_cast<AxisService>(command.code);
}

// Returns whether it moves to a position.
inline bool is_move(AxisService service) noexcept {
  return service == AxisService::MoveAbsolute || service == AxisService::MoveRelative ||
         service == AxisService::MoveAdditive;
}

// Returns whether it moves through a position and continues.
inline bool goes_on_from(AxisService service) noexcept {
  return service == AxisService::MoveContinuousAbsolute || service == AxisService::MoveContinuousRelative;
}

// Returns whether it follows another axis, or the tool.
inline bool follows(AxisService service) noexcept {
  return service == AxisService::GearIn || service == AxisService::CamIn || service == AxisService::GearInPos ||
         service == AxisService::Combine || service == AxisService::FollowPath;
}

// Returns whether it moves by a time table.
inline bool is_profile(AxisService service) noexcept {
  return service == AxisService::PositionProfile || service == AxisService::VelocityProfile ||
         service == AxisService::AccelerationProfile;
}

}  // namespace indurop::robot
