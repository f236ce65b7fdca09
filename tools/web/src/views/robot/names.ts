// SPDX-License-Identifier: Apache-2.0
// Names of the robot task's states and commands, by their numbers in the .glb file of every robot (docs/robot.md).

export const GROUP_STATES = ["disabled", "standby", "moving", "homing", "stopping", "error stop"];
export const JOB_STATES = ["idle", "running", "waiting", "ended", "failed", "paused", "resuming"];
export const SERVICE = { enable: 1, reset: 3, stop: 10, job_stop: 12, job_reload: 26 };  // OPCODE_ROBOT_SERVICE

// The name that a .glb file gives an error, "ROBOT_ERR_JOINT_LIMIT"; empty: none.
export function name_of_error(error: number, enumerators: Record<string, number> | undefined): string {
  return Object.entries(enumerators ?? {}).find(([, value]) => value === error)?.[0] ?? "";
}

// It is shown as "joint limit".
export function error_text(error: number, enumerators: Record<string, number> | undefined): string {
  const name = name_of_error(error, enumerators);
  return name ? `Error ${error}, ${name.replace(/^.*ERR_/, "").replaceAll("_", " ").toLowerCase()}` : `Error ${error}`;
}
