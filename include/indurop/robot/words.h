// SPDX-License-Identifier: Apache-2.0
// The numbers by which a PLC program and the robot task speak with each other. Append-only; a .glb declares the same
// names for PLC programs (examples/robot_cell/plc_robot.glb).

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
  // The others by commands only.
  DirectRelative,
  LinearRelative,
  CircularAbsolute,
  CircularRelative,
  Halt,
  Interrupt,
  Continue,
  SetTransform,
  SelectCam,  // takes table `option` as a cam; `job` 1: periodic
  // By requests only: the job files are read anew.
  JobReload,
  // By commands.
  TrackBelt,  // the product moves with belt `option`, along x of `to`, from `aux` in it on
  TrackTable  // likewise about z of `to`
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
  CamIn,  // follows axis `option` on cam `job`: to has offset and scale of both, aux whether zeros are those of the
          // axes
  MoveSuperimposed,  // by to[0] on top of what it does, `velocity` faster at most
  HaltSuperimposed,
  TouchProbe,  // where the next edge is; `option` 1: a falling one, + 2: of the mark; `job` 1: from to[0] to to[1] only
  AbortTrigger,
  // As GearIn, from where it is at to[3] and its master at to[2] on; on the last to[4] of the master's way it gets
  // there.
  GearInPos,
  Combine,      // follows axes `option` and `job` with to[0] / to[1] and to[2] / to[3] of their speeds
  ShiftMaster,  // of a follower of axis `option`: sees its master to[0] further on; `job` 1: so much more than it does
  MoveContinuousAbsolute,  // passes to[0] with the velocity to[1], which may have a sign, and goes on with it
  MoveContinuousRelative,
  WriteParameter,   // parameter `option` of the standard becomes to[0]
  PositionProfile,  // table `job` of times: to[0] is the scale of time, to[1] that of values, to[2] is added to them
  VelocityProfile,
  AccelerationProfile,
  TorqueControl  // pushes with to[0] N m (N), which grows by to[1] in a second, no faster than `velocity`
};

enum class ErrorCode : std::uint32_t {
  Ok,
  Opcode,        // no such service
  State,         // not possible in this state
  Point,         // no such point
  Job,           // no such job
  Value,         // a value that is no number or out of its range
  Unreachable,   // the target is out of reach
  JointLimit,    // the target or the way there is beyond a joint's limit
  Singular,      // the way comes too near a singular position
  Speed,         // the way would need a joint to be faster than it can
  Circle,        // the points of a circle lie on a line
  Drive,         // a drive reports a fault
  Following,     // an axis does not follow
  Power,         // a drive does not take power, or lost it
  Emergency,     // emergency stop
  Line,          // a line of a job failed
  NotHomed,      // the axis does not know where it is
  Aborted,       // a later command took over
  Acceleration,  // the way would need a joint to accelerate harder than it can
  Jerk,          // the way would need a joint to change its acceleration faster than it can
  Workspace,     // the target or the way there is outside of the workspace
  Tool,          // no such tool
  NoResume,      // there is no job to go on with
  Away,          // the robot is too far from where its job left the path
  Full,          // more commands than there is room for
  Master,        // the axis to follow has no power, failed or looks for its place
  Enabling,      // manual mode, and the enabling switch is not held
  Mode,          // another operating mode was chosen
  Torque,        // an axis has not enough torque for it, however slow it is
  Collision,     // the target or the way there is too near to a zone, or to the arm itself
  Contact,       // something pushes against the arm
  Belt,          // the place of a belt is not told, jumps or goes too quickly
  NoTorque,      // the torque of an axis cannot be told: no masses, no rated torque, or its drive has no such mode
  Planner        // a thread of the robot task crashed; the task ends once the drives have no power
};

// How the robot is run (ISO 10218-1), as a key switch says.
enum class OperatingMode : std::int16_t {
  Any,        // there is no switch: jobs run, and it may be moved by hand
  Automatic,  // it is not moved by hand
  Manual      // at most 250 mm/s, and only while the enabling switch is held
};

// Stop categories of IEC 60204-1. Hold and ordinary stops are of category 2, disabling the group is of category 1, an
// emergency stop of category 1 or 0 (Settings::emergency_category).
enum class StopCategory : std::int16_t {
  Category0 = 0,  // power is taken away at once
  Category1 = 1,  // the robot is brought to rest, then power is taken away
  Category2 = 2   // the robot is brought to rest and keeps its power
};

enum class JobState : std::int16_t { Idle, Runs, Waits, Ended, Failed, Paused };

// "the target is out of reach", for messages.
[[gnu::visibility("default")]] const char* to_string(ErrorCode code) noexcept;

}  // namespace indurop::robot
