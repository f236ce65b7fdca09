// SPDX-License-Identifier: Apache-2.0
// The status of the robot task, as the .glb file of every robot declares it (docs/robot.md).

import { useEffect, useState } from "preact/hooks";
import { decode } from "../../api/decode";
import { stream } from "../../api/stream";
import type { Form, Robot, Variable } from "../../api/types";
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
  interrupted: string[];  // jobs that ON has interrupted, with their lines: "main, line 12"
  pending: string[];  // jobs that interrupts which wait will call, the next one first
  pending_count: number;  // there may be more of them than can be named
  job_message: string;
  override_set: number;
  hold: boolean;
  automatic: boolean;
  manual: boolean;
  guided: boolean;  // a hand may push the arm now
  mark: number;  // the number of the last mark of a guided path
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

// Variables of a robot that not every robot has, except the first one.
export const VARIABLES = ["ROBOT_ARM", "ROBOT_SPACE", "ROBOT_PATH", "ROBOT_GUIDE", "MC_BELT", "MC_TOOL"];

// What moves with the belts.
export interface Carried {
  belts: number[];  // mm, or deg of tables
  product: number[];  // x y z in mm, roll pitch yaw in deg, in the frame of the base
}

export interface Scope {
  name: string;  // namespace of a robot: PLC_ROBOT of PLC_ROBOT::ROBOT_ARM
  modules: string[];  // that write its variables, if known
  shares: boolean;  // it has a variable ROBOT_SPACE: the space that it shares with other robots
  tells_ways: boolean;  // it has a variable ROBOT_PATH: the motions that are planned
  guides: boolean;  // it has a variable ROBOT_GUIDE: a hand can guide it
  tracks: boolean;  // it has MC_BELT and MC_TOOL: belts, and what moves with them
}

// From the variables called as in VARIABLES.
export function scopes_of(variables: Variable[]): Scope[] {
  const shared = new Set(variables.map(({ name }) => name));
  const has = (arm: string, other: string) => shared.has(arm.replace(/ROBOT_ARM$/, other));
  return variables.filter(({ name, form }) => /(^|::)ROBOT_ARM$/.test(name) && form.kind === "struct")
    .map(({ name, writers }) => ({ name: name.replace(/(::)?ROBOT_ARM$/, ""), modules: writers ?? [],
      shares: has(name, "ROBOT_SPACE"), tells_ways: has(name, "ROBOT_PATH"), guides: has(name, "ROBOT_GUIDE"),
      tracks: has(name, "MC_BELT") && has(name, "MC_TOOL") }));
}

function name_of(list: string[], state: unknown): string {
  return list[Number(state)] ?? `state ${state}`;
}

// The first ones of a list of fixed size.
function named<T>(list: any[] | undefined, count: number | undefined, text: (one: any) => T): T[] {
  return (list ?? []).slice(0, count ?? 0).map(text);
}

function state_of(values: Record<string, any>, errors: Record<string, number> | undefined): RobotState {
  const { arm = {}, module = {}, job = {}, space = {}, guide = {} } = values;
  return {
    joint: arm.joint ?? [], command: arm.command ?? [], speed: arm.speed ?? [], position: arm.position ?? [],
    orientation: arm.orientation ?? [], tool_speed: arm.tool_speed ?? NaN, override_now: arm.override_now ?? NaN, remaining_s: arm.to_go ?? NaN,
    group: name_of(GROUP_STATES, module.eState), error: module.nError ? error_text(module.nError, errors) : "",
    error_name: module.nError ? name_of_error(module.nError, errors) : "", resumable: !!job.bResume,
    job: job.name ?? "", job_line: job.nLine ?? 0,
    job_called: job.called || job.name || "", job_state: name_of(JOB_STATES, job.eState), job_message: job.cMessage ?? "",
    interrupted: named(job.interrupted, job.nInterrupted, ({ name, nLine }) => `${name}, line ${nLine}`),
    pending: named(job.pending, job.nPending, ({ name }) => name), pending_count: job.nPending ?? 0,
    override_set: values.override ?? NaN, hold: !!values.hold, acknowledged: module.nAcknowledge ?? 0,
    tool: arm.nTool ?? 0,
    waits_for: space.cWaitsFor ?? "", automatic: arm.eMode === 1, manual: arm.eMode === 2, guided: !!arm.bGuided, mark: guide.nMark ?? 0, may_move: arm.bMayMove !== 0,
  };
}

function field_of(form: Form | undefined, name: string): Form | undefined {
  return form?.fields?.find((field) => field.name === name)?.type;
}

// `each` is called with every frame; the numbers on the page are updated less often.
export function useRobotState(board: string, robot: Scope | null, each: (state: RobotState) => void): RobotState | null {
  const scope = robot && robot.name;
  const shares = robot !== null && robot.shares;
  const guides = robot !== null && robot.guides;
  const [state, set_state] = useState<RobotState | null>(null);
  useEffect(() => {
    set_state(null);
    if (scope === null || !board) return;
    const prefix = scope ? `${scope}::` : "";
    const names: Record<string, string> = {
      [`${prefix}ROBOT_ARM`]: "arm", [`${prefix}ROBOT_MODULE_STATE`]: "module", [`${prefix}ROBOT_JOB`]: "job",
      [`${prefix}ROBOT_OVERRIDE`]: "override", [`${prefix}ROBOT_HOLD`]: "hold",
      ...(shares ? { [`${prefix}ROBOT_SPACE`]: "space" } : {}),
      ...(guides ? { [`${prefix}ROBOT_GUIDE`]: "guide" } : {}),
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
  }, [board, scope, shares, guides]);
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

// `each` is called after every change.
export function useCarried(board: string, robot: Scope | null, each: (carried: Carried) => void): void {
  const scope = robot?.tracks ? robot.name : null;
  useEffect(() => {
    if (scope === null || !board) return;
    const prefix = scope ? `${scope}::` : "";
    let last = "";
    return stream.subscribe({
      board, names: [`${prefix}MC_BELT`, `${prefix}MC_TOOL.dTransform`], rate_hz: WAYS_HZ, binary: true,
      frame: (frame, of) => {
        const [belts, product] = of.variables.map(({ offset, form }) => decode(frame.view, offset, form)) as [any[], number[]];
        const carried = { belts: belts.map(({ dPlace }) => dPlace), product };
        const now = JSON.stringify(carried);
        if (now !== last) each(carried);
        last = now;
      },
    });
  }, [board, scope]);
}

// How many places of each pallet are in use; NaN: not known. `each` is called after every change.
export function useUsed(board: string, robot: Robot | null, each: (used: number[]) => void): number[] {
  const [used, set_used] = useState<number[]>([]);
  const names = (robot?.pallets ?? []).map((pallet) => pallet.used);
  const wanted = names.join(" ");
  useEffect(() => {
    set_used([]);
    if (!wanted || !board) return;
    let last = "";
    return stream.subscribe({
      board, names: [...new Set(names)], rate_hz: WAYS_HZ, binary: true,
      frame: (frame, of) => {
        const counts = Object.fromEntries(of.variables.map(({ name, offset, form }) => [name, Number(decode(frame.view, offset, form))]));
        // Leading namespaces may be left out.
        const now = names.map((wanted) => Object.entries(counts).find(([name]) => name === wanted || name.endsWith(`::${wanted}`))?.[1] ?? NaN);
        if (JSON.stringify(now) === last) return;
        last = JSON.stringify(now);
        set_used(now);
        each(now);
      },
    });
  }, [board, wanted]);
  return used;
}
