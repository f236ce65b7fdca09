// SPDX-License-Identifier: Apache-2.0
// What the numbers of the robot task mean, by their values, as the .glb of every robot declares them (docs/robot.md).

export const GROUP_STATES = ["no power", "standing by", "moving", "homing", "stopping", "stopped by an error"];
export const JOB_STATES = ["idle", "runs", "waits", "has ended", "failed", "pauses"];
export const SERVICE = { enable: 1, reset: 3, stop: 10, job_stop: 12 };  // OPCODE_ROBOT_SERVICE

// "ROBOT_ERR_JOINT_LIMIT" of a .glb that has names for them: "joint limit".
export function error_text(error: number, enumerators: Record<string, number> | undefined): string {
  const name = Object.entries(enumerators ?? {}).find(([, value]) => value === error)?.[0];
  return name ? `Error ${error}, ${name.replace(/^.*ERR_/, "").replaceAll("_", " ").toLowerCase()}` : `Error ${error}`;
}
