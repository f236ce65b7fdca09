// SPDX-License-Identifier: Apache-2.0
// What to do next after an error: how to remove its cause, by its number in ROBOT_ERROR (plc_robot.glb), and the step that
// the present state of the group and of the job asks for.

import type { RobotState } from "./state";

// A sentence each, or part of one that continues with ", then ...".
const REMEDIES: Record<string, string> = {
  ROBOT_ERR_OPCODE: "Request a service that this robot has",
  ROBOT_ERR_STATE: "Request it in a state in which it is possible",
  ROBOT_ERR_POINT: "Declare the point in the files of the jobs, or name another one",
  ROBOT_ERR_JOB: "Add the job to the property jobs, or start another one",
  ROBOT_ERR_VALUE: "Correct the speed, acceleration or angle that was given",
  ROBOT_ERR_UNREACHABLE: "Teach the target again within reach, or hold the tool that it was taught with",
  ROBOT_ERR_JOINT_LIMIT: "Jog the axis back inside its range if it is at its end, or choose a target that keeps away from it",
  ROBOT_ERR_SINGULAR: "Go there by a joint motion (MOVJ), or move the line away from the singular position",
  ROBOT_ERR_SPEED: "Reduce the speed of the motion, or move its path away from singular positions",
  ROBOT_ERR_CIRCLE: "Teach the middle point of the circle again, off the line between its ends",
  ROBOT_ERR_DRIVE: "Remove the fault that the drive shows",
  ROBOT_ERR_FOLLOWING: "Check whether something blocks the axis and whether its brake is released",
  ROBOT_ERR_POWER: "Check the supply, the safety circuit and the drive of the axis",
  ROBOT_ERR_EMERGENCY: "Release the emergency stop and clear the light curtain",
  ROBOT_ERR_LINE: "Correct the line of the job that the message names",
  ROBOT_ERR_NOT_HOMED: "Home the axes (SVC_AD_GROUP_HOME)",
  ROBOT_ERR_ABORTED: "Nothing is wrong: a later command replaced this one",
  ROBOT_ERR_ACCELERATION: "Reduce the speed of the motion, or move its path away from singular positions",
  ROBOT_ERR_JERK: "Reduce the speed of the motion, or move its path away from singular positions",
  ROBOT_ERR_WORKSPACE: "Jog the tool back inside the workspace if it is outside, or choose a target inside",
  ROBOT_ERR_TOOL: "Declare the tool in the files of the jobs, or select another one",
  ROBOT_ERR_NO_RESUME: "Start the job from its beginning, or at a line",
  ROBOT_ERR_AWAY: "Jog the tool back to where the job left its path",
  ROBOT_ERR_FULL: "Wait until earlier commands have ended",
  ROBOT_ERR_MASTER: "Enable, reset or home the axis that is to be followed",
  ROBOT_ERR_ENABLING: "Hold the enabling switch",
  ROBOT_ERR_MODE: "Choose the operating mode in which to continue",
  ROBOT_ERR_TORQUE: "Reduce the load, or choose a path on which the arm stretches less",
  ROBOT_ERR_COLLISION: "Jog the arm away from the body or zone if it is too near, or go around it (MOVE FREE)",
  ROBOT_ERR_CONTACT: "Free the arm: find what pushed against it",
  ROBOT_ERR_BELT: "Check the encoder of the belt and the module that reads it",
  ROBOT_ERR_NO_TORQUE: "Give the masses (URDF) and the property rated_torque, or use drives with mode 10",
  ROBOT_ERR_PLANNER: "Restart the module of the robot, and report its messages: this is a defect of the software",
  ROBOT_ERR_WAVE: "Turn the tool away from the direction of the path, or do not weave there",
  ROBOT_ERR_NO_WAY: "Remove what is in the way, or allow the search more time (WITHIN)",
  ROBOT_ERR_OTHER_ROBOT: "Move the other robot out of the way",
  ROBOT_ERR_FORCE: "Find what the tool presses against, and check the force sensor",
};

// The step after the cause is gone; empty: none.
function step(state: RobotState): string {
  switch (state.group) {
    case "error stop": return state.resumable ? "reset the group, enable it if the drives have no power, and resume the job (SVC_JB_RESUME)" : "reset the group, and enable it if the drives have no power";
    case "disabled": return state.resumable ? "enable the group and resume the job (SVC_JB_RESUME)" : "enable the group";
    case "standby": return state.resumable ? "resume the job (SVC_JB_RESUME), or start another one" : state.job_state === "failed" ? "start the job again" : "request it again";
    default: return "";
  }
}

// One line; empty: nothing is to be done.
export function way_out(state: RobotState): string {
  if (state.group === "stopping") return "Wait until the robot is at rest.";
  if (!state.error_name && state.job_state !== "failed") return "";
  if (state.error_name === "ROBOT_ERR_ABORTED" && state.group !== "error stop") return `${REMEDIES.ROBOT_ERR_ABORTED}.`;
  if (state.error_name === "ROBOT_ERR_PLANNER") return `${REMEDIES.ROBOT_ERR_PLANNER}.`;
  const remedy = REMEDIES[state.error_name] ?? (state.job_state === "failed" ? REMEDIES.ROBOT_ERR_LINE : "Remove the cause");
  const then = step(state);
  return then ? `${remedy}, then ${then}.` : `${remedy}.`;
}
