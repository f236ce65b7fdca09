// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/errors.h"

namespace indurop::robot {

// Long: one line for each code.
const char* to_string(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::Ok:
      return "no error";
    case ErrorCode::Opcode:
      return "there is no such service";
    case ErrorCode::State:
      return "not possible in this state";
    case ErrorCode::Point:
      return "there is no such point";
    case ErrorCode::Job:
      return "there is no such job";
    case ErrorCode::Value:
      return "a value is not a number or is out of range";
    case ErrorCode::Unreachable:
      return "the target is out of reach";
    case ErrorCode::JointLimit:
      return "the target or the way there is beyond a joint's limit";
    case ErrorCode::Singular:
      return "the way comes too near a singular position";
    case ErrorCode::Speed:
      return "the way would need a joint to be faster than it can";
    case ErrorCode::Circle:
      return "start, middle and end of the circle lie on a line";
    case ErrorCode::Drive:
      return "a drive reports a fault";
    case ErrorCode::Following:
      return "an axis does not follow";
    case ErrorCode::Power:
      return "a drive does not take power, or lost it";
    case ErrorCode::Emergency:
      return "emergency stop";
    case ErrorCode::Line:
      return "a line of the job failed";
    case ErrorCode::NotHomed:
      return "an axis does not know where it is, home it first";
    case ErrorCode::Aborted:
      return "a later command took over";
    case ErrorCode::Acceleration:
      return "the way would need a joint to accelerate harder than it can";
    case ErrorCode::Jerk:
      return "the way would need a joint to change its acceleration faster than it can";
    case ErrorCode::Workspace:
      return "the target or the way there is outside of the workspace";
    case ErrorCode::Tool:
      return "there is no such tool";
    case ErrorCode::NoResume:
      return "there is no job to go on with; start one";
    case ErrorCode::Away:
      return "the robot is too far from where its job left the path; bring it back there, or start the job again";
    case ErrorCode::Full:
      return "there are more commands than there is room for";
    case ErrorCode::Master:
      return "the axis to follow has no power, failed or looks for its place";
    case ErrorCode::Enabling:
      return "in manual mode the robot moves only while the enabling switch is held; hold it and ask again";
    case ErrorCode::Mode:
      return "another operating mode was chosen; ask again once the robot stands";
    case ErrorCode::Torque:
      return "an axis has not enough torque to hold the arm on the way there; hold less, nearer, or go another way";
    case ErrorCode::Collision:
      return "the arm would touch itself, what it holds or a zone";
    case ErrorCode::Contact:
      return "something pushes against the arm, or it does not hold what TOOL and LOAD say";
    case ErrorCode::Belt:
      return "the belt has no position, jumps or moves too fast; check its encoder, then track it again";
    case ErrorCode::NoTorque:
      return "the axis cannot push with a torque: rated_torque, masses in the URDF, or the drive's mode 10 is missing";
    case ErrorCode::Planner:
      return "a thread of the robot task crashed; start the task again, and report what the module's fault says";
    case ErrorCode::Wave:
      return "the tool points along the way, so there is no side to weave to; turn the tool, or end it with WEAVE OFF";
    case ErrorCode::NoWay:
      return "no way around what is in the way was found in time; add a point between, or give it longer, WITHIN 20 s";
    case ErrorCode::OtherRobot:
      return "another robot came into the way, or both wait for each other";
    case ErrorCode::Force:
      return "the tool presses with more force than is permitted, or its sensor is silent";
  }
  return "unknown error";
}

}  // namespace indurop::robot
