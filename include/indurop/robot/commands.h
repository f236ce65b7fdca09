// SPDX-License-Identifier: Apache-2.0
// Commands as issued by function blocks of PLCopen Motion Control: each one has its own number and its outcome is
// reported individually. They are in slots of a shared variable (MC_COMMAND), answers in another one (MC_ANSWER).

#pragma once

#include <indurop/robot/words.h>

#include <array>
#include <cstdint>

namespace indurop::robot {

inline constexpr std::size_t kCommands = 32;  // slots
inline constexpr std::size_t kCams = 4;
inline constexpr std::size_t kCamPoints = 64;
inline constexpr std::size_t kBelts = 2;
inline constexpr std::size_t kProfiles = 8;
inline constexpr std::size_t kProfilePoints = 64;

// The effect of a command on those before it.
enum class BufferMode : std::int16_t {
  Aborting,  // at once, replacing them
  Buffered,  // after them
  // After them, passing the end of the previous motion with the lower velocity of both, that of the previous one, its
  // own, the higher one.
  BlendingLow,
  BlendingPrevious,
  BlendingNext,
  BlendingHigh
};

// For axes that turn endlessly: the direction to an absolute position. None: as given by the position values.
enum class Direction : std::int16_t { None, Positive, Shortest, Negative, Current };

// Coordinates of the axes, of the machine (the base), of the product.
enum class CoordSystem : std::int16_t { Axes, Machine, Product };

enum class CircleMode : std::int16_t { Border, Center, Radius };

enum class CommandState : std::int32_t {
  None,
  Waits,   // accepted; others are before it
  Active,  // controls the axis or the group
  Done,
  Aborted,
  Error
};

// Zero in velocity, acceleration, deceleration and jerk means the maximum; degrees are millimetres for a sliding axis.
struct Command {
  std::uint32_t number = 0;   // differs from the last one in this slot: a new command; the lower number comes first
  std::int32_t code = 0;      // AxisService or, if axis is 0, Service
  std::int32_t axis = 0;      // from 1; 0: the group
  std::uint32_t updates = 0;  // differs from last time: the other fields have changed and take effect at once
  BufferMode buffer = BufferMode::Aborting;
  Direction direction = Direction::None;
  CoordSystem coords = CoordSystem::Axes;
  std::int16_t option = 0;     // for a circle: CircleMode, + 16: clockwise; for a set position: 1 is relative
  std::int16_t execute = 0;    // for stops: 1 as long as they hold
  std::int16_t job = 0;        // for JobStart
  std::array<double, 8> to{};  // deg; a pose: mm and deg; a single axis uses the first
  // For circles: the point between, the centre or the radius as a vector. For tracking: the product on the belt or
  // table. For FreeAbsolute: seed and s of the search.
  std::array<double, 8> aux{};
  double velocity = 0;      // deg/s, mm/s; joint motions of the group: %
  double acceleration = 0;  // deg/s^2
  double deceleration = 0;  // deg/s^2; 0: as acceleration
  double jerk = 0;          // deg/s^3
  double transition = 0;    // mm, with blending: at most this far before the previous motion's end the path turns
};

// The table of a cam: the master's position increases from point to point. Both columns are in the units of
// their axes, or are scaled to them by the command that uses the cam.
struct CamTable {
  std::int16_t points = 0;
  std::array<double, kCamPoints> master{};
  std::array<double, kCamPoints> slave{};
};

// The table of a profile: position, velocity or torque of an axis at times after its start, which increase from above
// 0.
struct ProfileTable {
  std::uint32_t command = 0;  // number of the command that uses it
  std::int16_t points = 0;
  std::array<double, kProfilePoints> time{};  // s
  std::array<double, kProfilePoints> value{};
};

struct CommandAnswer {
  std::uint32_t number = 0;
  CommandState state = CommandState::None;
  ErrorCode error = ErrorCode::Ok;
  bool reached = false;  // for endless motions: has reached the velocity or is in gear; or had, when replaced
};

using CamTables = std::array<CamTable, kCams>;
using ProfileTables = std::array<ProfileTable, kProfiles>;
using Commands = std::array<Command, kCommands>;
using CommandAnswers = std::array<CommandAnswer, kCommands>;

}  // namespace indurop::robot
