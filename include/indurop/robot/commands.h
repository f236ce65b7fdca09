// SPDX-License-Identifier: Apache-2.0
// Commands as function blocks of PLCopen Motion Control give them: each one has a number of its own and learns its own
// end. They lie in places of a shared variable (MC_COMMAND), answers in another one (MC_ANSWER).

#pragma once

#include <indurop/robot/words.h>

#include <array>
#include <cstdint>

namespace indurop::robot {

inline constexpr std::size_t kCommands = 32;  // places
inline constexpr std::size_t kCams = 4;
inline constexpr std::size_t kCamPoints = 64;
inline constexpr std::size_t kBelts = 2;
inline constexpr std::size_t kProfiles = 4;
inline constexpr std::size_t kProfilePoints = 64;

// What a command does with those before it.
enum class BufferMode : std::int16_t {
  Aborting,  // at once and instead of them
  Buffered,  // after them
  // After them, passing the end of the one before with the lower velocity of both, that of the one before, its own, the
  // higher one.
  BlendingLow,
  BlendingPrevious,
  BlendingNext,
  BlendingHigh
};

// Of axes that turn on and on: which way to an absolute position. None: as the numbers say.
enum class Direction : std::int16_t { None, Positive, Shortest, Negative, Current };

// Coordinates of the axes, of the machine (the base), of the product.
enum class CoordSystem : std::int16_t { Axes, Machine, Product };

enum class CircleMode : std::int16_t { Border, Center, Radius };

enum class CommandState : std::int32_t {
  None,
  Waits,   // taken; others are before it
  Active,  // has the axis or the group
  Done,
  Aborted,
  Error
};

// Zeros in velocity, acceleration, deceleration and jerk stand for the most there is; degrees are millimetres where an
// axis slides.
struct Command {
  std::uint32_t number = 0;   // another one than last time in this place: a new command; the lower one comes first
  std::int32_t code = 0;      // AxisService or, if axis is 0, Service
  std::int32_t axis = 0;      // from 1; 0: the group
  std::uint32_t updates = 0;  // another one than last time: its other fields have changed, and count at once
  BufferMode buffer = BufferMode::Aborting;
  Direction direction = Direction::None;
  CoordSystem coords = CoordSystem::Axes;
  std::int16_t option = 0;     // of a circle: CircleMode, + 16: clockwise; of a position that is set: 1 is relative
  std::int16_t execute = 0;    // of stops: 1 as long as they hold
  std::int16_t job = 0;        // of JobStart
  std::array<double, 8> to{};  // deg; a pose: mm and deg; a single axis has the first
  // Of circles: the point between, the centre or the radius as a vector. Of what is tracked: the product on it.
  std::array<double, 8> aux{};
  double velocity = 0;      // deg/s, mm/s; joint motions of the group: %
  double acceleration = 0;  // deg/s^2
  double deceleration = 0;  // deg/s^2; 0: as acceleration
  double jerk = 0;          // deg/s^3
  double transition = 0;    // mm, with blending: how far before the end of the motion before it the path may turn
};

// Of a cam: the master's place rises from point to point. Numbers of both are as their users count, or what they scale
// it with.
struct CamTable {
  std::int16_t points = 0;
  std::array<double, kCamPoints> master{};
  std::array<double, kCamPoints> slave{};
};

// Of a profile: where, how fast or how hard an axis is to be at times after its beginning, which rise from above 0.
struct ProfileTable {
  std::uint32_t command = 0;  // number of the command that it is for
  std::int16_t points = 0;
  std::array<double, kProfilePoints> time{};  // s
  std::array<double, kProfilePoints> value{};
};

struct CommandAnswer {
  std::uint32_t number = 0;
  CommandState state = CommandState::None;
  ErrorCode error = ErrorCode::Ok;
  bool reached = false;  // of motions without an end: has the velocity, is in gear; or had, as the next took over
};

using CamTables = std::array<CamTable, kCams>;
using ProfileTables = std::array<ProfileTable, kProfiles>;
using Commands = std::array<Command, kCommands>;
using CommandAnswers = std::array<CommandAnswer, kCommands>;

}  // namespace indurop::robot
