// SPDX-License-Identifier: Apache-2.0
// The status of the robot task, as the .glb file of every robot declares it (docs/robot.md).

import { useEffect, useState } from "preact/hooks";
import { decode } from "../../api/decode";
import { stream } from "../../api/stream";
import type { Form, Variable } from "../../api/types";
import { error_text, GROUP_STATES, JOB_STATES, name_of_error } from "./names";

const RATE_HZ = 25;
const WAYS_HZ = 10;

export interface RobotState {
  joint: number[];
  command: number[];
  speed: number[];
  position: number[];
  orientation: number[];
  tool_speed: number;
  override_now: number;
  remaining_s: number;
  group: string;
  error: string;  // as text; empty: none
  error_name: string;  // its name in the .glb file; empty: none
  resumable: boolean;  // SVC_JB_RESUME can continue the job
  job: string;
  job_line: number;
  job_called: string;  // the job that this line belongs to: the job itself, or one that it called
  job_state: string;
  job_message: string;
  override_set: number;
  hold: boolean;
  automatic: boolean;
  may_move: boolean;  // operating mode and enabling device allow it
  waits_for: string;  // the robot that has to leave its way; empty: none
  tool: number;  // held; 0: none
  acknowledged: number;  // the number of the service that was accepted last
}

// A planned motion: where the tool will go, in the order of time.
export interface Way {
  places: number[][];  // mm
  speeds: number[];  // mm/s
}

export interface Scope {
  name: string;  // namespace of a robot: PLC_ROBOT of PLC_ROBOT::ROBOT_ARM
  modules: string[];  // that write its variables, if known
  shares: boolean;  // it has a variable ROBOT_SPACE: the space that it shares with other robots
  tells_ways: boolean;  // it has a variable ROBOT_PATH: the motions that are planned
}

// From the variables called ROBOT_ARM, ROBOT_SPACE and ROBOT_PATH.
export function scopes_of(variables: Variable[]): Scope[] {
  const shared = new Set(variables.map(({ name }) => name));
  return variables.filter(({ name, form }) => /(^|::)ROBOT_ARM$/.test(name) && form.kind === "struct")
    .map(({ name, writers }) => ({ name: name.replace(/(::)?ROBOT_ARM$/, ""), modules: writers ?? [],
      shares: shared.has(name.replace(/ROBOT_ARM$/, "ROBOT_SPACE")), tells_ways: shared.has(name.replace(/ROBOT_ARM$/, "ROBOT_PATH")) }));
}

function name_of(list: string[], state: unknown): string {
  return list[Number(state)] ?? `state ${state}`;
}

function state_of(values: Record<string, any>, errors: Record<string, number> | undefined): RobotState {
  const { arm = {}, module = {}, job = {}, space = {} } = values;
  return {
    joint: arm.joint ?? [], command: arm.command ?? [], speed: arm.speed ?? [], position: arm.position ?? [],
    orientation: arm.orientation ?? [], tool_speed: arm.tool_speed ?? NaN, override_now: arm.override_now ?? NaN, remaining_s: arm.to_go ?? NaN,
    group: name_of(GROUP_STATES, module.eState), error: module.nError ? error_text(module.nError, errors) : "",
    error_name: module.nError ? name_of_error(module.nError, errors) : "", resumable: !!job.bResume,
    job: job.name ?? "", job_line: job.nLine ?? 0,
    job_called: job.called || job.name || "", job_state: name_of(JOB_STATES, job.eState), job_message: job.cMessage ?? "",
    override_set: values.override ?? NaN, hold: !!values.hold, acknowledged: module.nAcknowledge ?? 0,
    tool: arm.nTool ?? 0,
    waits_for: space.cWaitsFor ?? "", automatic: arm.eMode === 1, may_move: arm.bMayMove !== 0,
  };
}

function field_of(form: Form | undefined, name: string): Form | undefined {
  return form?.fields?.find((field) => field.name === name)?.type;
}

// `each` is called with every frame; the numbers on the page are updated less often.
export function useRobotState(board: string, robot: Scope | null, each: (state: RobotState) => void): RobotState | null {
  const scope = robot && robot.name;
  const shares = robot !== null && robot.shares;
  const [state, set_state] = useState<RobotState | null>(null);
  useEffect(() => {
    set_state(null);
    if (scope === null || !board) return;
    const prefix = scope ? `${scope}::` : "";
    const names: Record<string, string> = {
      [`${prefix}ROBOT_ARM`]: "arm", [`${prefix}ROBOT_MODULE_STATE`]: "module", [`${prefix}ROBOT_JOB`]: "job",
      [`${prefix}ROBOT_OVERRIDE`]: "override", [`${prefix}ROBOT_HOLD`]: "hold",
      ...(shares ? { [`${prefix}ROBOT_SPACE`]: "space" } : {}),
    };
    let updated = 0;
    return stream.subscribe({
      board, names: Object.keys(names), rate_hz: RATE_HZ, binary: true,
      frame: (frame, of) => {
        const values = Object.fromEntries(of.variables.map(({ name, offset, form }) => [names[name], decode(frame.view, offset, form)]));
        const module = of.variables.find(({ name }) => names[name] === "module")?.form;
        const next = state_of(values, field_of(module, "nError")?.enumerators);
        each(next);
        if (Date.now() - updated < 100) return;
        updated = Date.now();
        set_state(next);
      },
    });
  }, [board, scope, shares]);
  return state;
}

function ways_of(motions: any[]): Way[] {
  return motions.map(({ nPlaces, place, speed }) => ({
    places: Array.from({ length: nPlaces }, (_, i) => place.slice(3 * i, 3 * i + 3)), speeds: speed.slice(0, nPlaces),
  })).filter(({ places }) => places.length > 0);
}

// `each` is called after every change.
export function useWays(board: string, robot: Scope | null, each: (ways: Way[]) => void): void {
  const scope = robot?.tells_ways ? robot.name : null;
  useEffect(() => {
    if (scope === null || !board) return;
    let last = "";
    return stream.subscribe({
      board, names: [`${scope ? `${scope}::` : ""}ROBOT_PATH`], rate_hz: WAYS_HZ, binary: true,
      frame: (frame, of) => {
        const { motion } = decode(frame.view, of.variables[0].offset, of.variables[0].form) as { motion: any[] };
        const ways = ways_of(motion);
        const now = JSON.stringify(ways);
        if (now !== last) each(ways);
        last = now;
      },
    });
  }, [board, scope]);
}
