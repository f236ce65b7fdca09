// SPDX-License-Identifier: Apache-2.0
// The numbers that a PLC program and the robot task exchange. Append-only; a .glb declares the same names for PLC
// programs (examples/robot_cell/plc_robot.glb).

#pragma once

#include <cstdint>

namespace indurop::robot {

// State of the group of axes, as in PLCopen Motion Control part 4.
enum class GroupState : std::int16_t { Disabled, Standby, Moving, Homing, Stopping, ErrorStop };

// State of one axis, as in PLCopen Motion Control part 1.
enum class AxisState : std::int32_t {
  Disabled,
  Standstill,
  Homing,
  DiscreteMotion,
  ContinuousMotion,
  SynchronizedMotion,
  Stopping,
  ErrorStop
};

// Services of the group.
enum class Service : std::int32_t {
  None,
  GroupEnable,
  GroupDisable,
  GroupReset,
  GroupHome,
  MoveJoints,
  MoveLine,
  MoveCircle,
  DirectAbsolute,
  LinearAbsolute,
  Stop,
  JobStart,
  JobStop,
  DirectAborting,
  SelectTool,
  JobResume,
  JobBack,
  // The following ones by commands only.
  DirectRelative,
  LinearRelative,
  CircularAbsolute,
  CircularRelative,
  Halt,
  Interrupt,
  Continue,
  SetTransform,
  SelectCam,  // takes table `option` as a cam; `job` 1: periodic
  // By requests only: the job files are read again.
  JobReload,
  // By commands.
  TrackBelt,     // the product moves with belt `option`, along x of `to`, starting from `aux` in it
  TrackTable,    // the same about z of `to`
  FreeAbsolute,  // around obstacles; `aux`: seed of the search, and s that it may take at most, 0: 10
  // The path follows single axis `option`, or belt `job`: to[0] / to[1] mm for each mm or degree of it; to[2]: mm that
  // it may be behind or ahead, 0: any distance.
  FollowMaster,
  // The tool presses as long as `execute` is 1. `to`: N along x, y and z, N that are measured, and the count of the
  // measurements; each update has new ones, at least every 0.1 s. `aux`: N/mm of the contact along each axis, 0: the
  // tool does not press along it; N at most; mm at most; s after which the count has to have changed, 0: any time.
  // `velocity`: mm/s at most. `option` 1: along the axes of the tool.
  Press
};

// Services of one axis.
enum class AxisService : std::int32_t {
  None,
  PowerOn,
  PowerOff,
  Home,
  MoveAbsolute,
  MoveRelative,
  MoveVelocity,
  Stop,
  Reset,
  Halt,
  MoveAdditive,
  SetPosition,
  GearIn,  // follows axis `option` with to[0] / to[1] of its speed
  Decouple,
  CamIn,  // follows axis `option` on cam `job`: to has offset and scale of both, aux whether their zeros are those of
          // the axes
  MoveSuperimposed,  // by to[0] on top of the current motion, at most `velocity` faster
  HaltSuperimposed,
  TouchProbe,  // position of the next edge; `option` 1: falling, + 2: of the mark; `job` 1: from to[0] to to[1] only
  AbortTrigger,
  // As GearIn, from its position to[3] and its master's position to[2] on; synchronizes over the last to[4] of the
  // master's distance.
  GearInPos,
  Combine,      // follows axes `option` and `job` with to[0] / to[1] and to[2] / to[3] of their speeds
  ShiftMaster,  // of a follower of axis `option`: shifts the master it sees by to[0]; `job` 1: by so much more than now
  MoveContinuousAbsolute,  // passes to[0] with the velocity to[1], which may have a sign, and continues with it
  MoveContinuousRelative,
  WriteParameter,   // sets parameter `option` of the standard to to[0]
  PositionProfile,  // table `job` of times: to[0] scales the time, to[1] the values, to[2] is added to the values
  VelocityProfile,
  AccelerationProfile,
  TorqueControl,  // applies to[0] N m (N), ramped by to[1] per second, no faster than `velocity`
  FollowPath      // of a single axis: follows the way of the tool with to[0] / to[1] mm or degrees for each mm of it
};

enum class ErrorCode : std::uint32_t {
  Ok,
  Opcode,        // no such service
  State,         // not possible in this state
  Point,         // no such point
  Job,           // no such job
  Value,         // a value that is not a number or out of range
  Unreachable,   // the target is out of reach
  JointLimit,    // the target or the path exceeds a joint limit
  Singular,      // the path comes too near a singular position
  Speed,         // the path would exceed the speed limit of a joint
  Circle,        // the points of a circle are on a line
  Drive,         // a drive reports a fault
  Following,     // an axis does not follow
  Power,         // a drive does not switch on, or lost its power
  Emergency,     // emergency stop
  Line,          // a line of a job failed
  NotHomed,      // the position of the axis is not known
  Aborted,       // a later command replaced it
  Acceleration,  // the path would exceed the acceleration limit of a joint
  Jerk,          // the path would exceed the jerk limit of a joint
  Workspace,     // the target or the path is outside the workspace
  Tool,          // no such tool
  NoResume,      // there is no job to resume
  Away,          // the robot is too far from where its job left the path
  Full,          // too many commands
  Master,        // the axis to follow has no power, failed or is homing
  Enabling,      // manual mode, and the enabling device is not held
  Mode,          // another operating mode was chosen
  Torque,        // an axis has not enough torque for it at any speed
  Collision,     // the target or the path is too near to a zone, or to the arm itself
  Contact,       // contact: an external force acts on the arm
  Belt,          // the position of a belt is not reported, jumps or changes too fast
  NoTorque,      // the torque of an axis is not known: no masses, no rated torque, or no such mode in its drive
  Planner,       // a thread of the robot task crashed; the task ends once the drives have no power
  Wave,          // the tool points along the path that it is to weave across
  NoWay,         // the search for a free motion found no way, or not in time
  OtherRobot,    // another robot came into the way, or both wait for each other
  Force          // of a tool that presses: more is measured than is permitted, or nothing new
};

// The operating mode of the robot (ISO 10218-1), as selected by a key switch.
enum class OperatingMode : std::int16_t {
  Any,        // no selector: jobs run, and jogging is allowed
  Automatic,  // no jogging
  Manual      // at most 250 mm/s, and only while the enabling device is held
};

// Stop categories of IEC 60204-1. Hold and ordinary stops are of category 2, disabling the group is of category 1, an
// emergency stop of category 1 or 0 (Settings::emergency_category).
enum class StopCategory : std::int16_t {
  Category0 = 0,  // power is removed at once
  Category1 = 1,  // the robot is stopped, then power is removed
  Category2 = 2   // the robot is stopped and keeps its power
};

// Resumes: the robot returns to the path of the job, which continues there.
enum class JobState : std::int16_t { Idle, Runs, Waits, Ended, Failed, Paused, Resumes };

// "the target is out of reach", for messages.
[[gnu::visibility("default")]] const char* to_string(ErrorCode code) noexcept;

}  // namespace indurop::robot
