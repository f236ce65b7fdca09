// SPDX-License-Identifier: Apache-2.0
// Requests that several panels of the view of a robot make.

import { board_path, message_of, post } from "../../api/http";
import { SERVICE } from "./names";
import type { RobotState } from "./state";

export function in_scope(scope: string, name: string): string {
  return scope ? `${scope}::${name}` : name;
}

// Lets the robot read its files again. Returns what to show.
export async function request_reload(board: string, scope: string, state: RobotState | null, reason: string): Promise<string> {
  try {
    const service = { [in_scope(scope, "ROBOT_MODULE_SERVICE")]: `{eOpCode: ${SERVICE.job_reload}, nRequest: ${(state?.acknowledged ?? 0) + 1}}` };
    await post(board_path(board, "/set"), { values: service, reason });
    return "A reload was requested.";
  } catch (error) {
    return message_of(error);
  }
}
