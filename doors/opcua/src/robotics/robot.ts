// SPDX-License-Identifier: Apache-2.0
// Robots of a board, as the variables of their robot tasks (docs/robot.md) and their URDF files describe them.

import { read_urdf, type Joint } from "../model/urdf";
import type { Form, RobotDescription, VariableDescription } from "../serve/types";

// Values of the enumerations of OPC 40010-1.
export const PROFILE = { other: 0, rotary: 1, rotary_endless: 2, linear: 3 } as const;
export const CATEGORY = { other: 0, articulated: 1, cartesian: 3 } as const;

export interface Axis {
  name: string;  // of its joint; empty: not known
  profile: number;
  unit: string;
}

export interface Robot {
  prefix: string;  // of its variables: PLC_ROBOT::
  name: string;  // PLC_ROBOT
  emergency_stop: string;  // variable
  axes: Axis[];
  model: string;  // empty: not known
  category: number;
}

// The variables of a robot task, and those of their fields that are shown.
const NEEDED: Record<string, Record<string, Form["kind"]>> = {
  ROBOT_ARM: { eMode: "enum" },
  ROBOT_JOB: { eState: "enum", name: "text", bResume: "i16" },
  ROBOT_MODULE_STATE: { nAXESGROUP: "u16", eState: "enum" },
  AXIS_STATE: { dPosition: "f64", dActualVelocity: "f64" },
};
const EMERGENCY_STOP = "EMERGENCY_STOP";
const CELL = "PLC_ROBOT::";  // all robots of a board share the emergency stop of the cell

export interface Group {
  prefix: string;
  name: string;
  emergency_stop: string;
  modules: string[];  // that write its variables
  most_axes: number;
  unit: string;  // of the positions of axes, as declared
}

export interface Found {
  groups: Group[];
  notes: string[];  // for people: robots that are not shown, and why
}

type ByName = Map<string, VariableDescription>;

function missing_of(variables: ByName, prefix: string): string | undefined {
  for (const [name, fields] of Object.entries(NEEDED)) {
    const form = variables.get(prefix + name)?.form;
    for (const [field, kind] of Object.entries(fields)) {
      if (form?.fields?.find((one) => one.name === field)?.type.kind !== kind) return `${prefix}${name}.${field}`;
    }
  }
  return variables.get(`${prefix}ROBOT_OVERRIDE`)?.form.kind === "f64" ? undefined : `${prefix}ROBOT_OVERRIDE`;
}

export function find_groups(list: VariableDescription[]): Found {
  const variables: ByName = new Map(list.map((one) => [one.name, one]));
  const found: Found = { groups: [], notes: [] };
  for (const { name, form, writers } of list) {
    const match = /^(.*::)?ROBOT_ARM$/.exec(name);
    if (!match || form.kind !== "struct") continue;
    const prefix = match[1] ?? "";
    const stop = [CELL, prefix].map((where) => where + EMERGENCY_STOP).find((one) => variables.get(one)?.form.fields?.some((field) => field.name === "bActive"));
    const missing = missing_of(variables, prefix) ?? (stop ? undefined : `${prefix}${EMERGENCY_STOP}.bActive`);
    if (missing || !stop) {
      found.notes.push(`${name}: the robot is not in DeviceSet, because there is no ${missing}; use the plc_robot.glb of this release`);
      continue;
    }
    const axes = variables.get(`${prefix}AXIS_STATE`)!.form;
    found.groups.push({
      prefix, name: prefix.replace(/::$/, "") || "robot", emergency_stop: stop, modules: writers ?? [],
      most_axes: axes.dims?.[0] ?? 0, unit: axes.fields!.find((field) => field.name === "dPosition")!.unit ?? "",
    });
  }
  return found;
}

function axis_of({ name, type }: Joint, declared: string): Axis {
  if (type === "prismatic") return { name, profile: PROFILE.linear, unit: "mm" };
  return { name, profile: type === "continuous" ? PROFILE.rotary_endless : PROFILE.rotary, unit: declared };
}

// Three or more turning axes in a chain, three sliding ones (ISO 8373).
function category_of(axes: Axis[], is_linkage: boolean): number {
  if (is_linkage || axes.length < 3) return CATEGORY.other;
  if (axes.every(({ profile }) => profile !== PROFILE.linear)) return CATEGORY.articulated;
  return axes.slice(0, 3).every(({ profile }) => profile === PROFILE.linear) ? CATEGORY.cartesian : CATEGORY.other;
}

// axes: number of them. Without a file that matches, nothing is known of their joints.
export function describe(group: Group, axes: number, files: RobotDescription[]): Robot {
  const text = files.find(({ module }) => group.modules.includes(module))?.urdf;
  const urdf = text === undefined ? null : read_urdf(text);
  const matches = urdf !== null && urdf.axes.length === axes;
  const list = matches
    ? urdf.axes.map((joint) => axis_of(joint, group.unit))
    : Array.from({ length: axes }, () => ({ name: "", profile: PROFILE.other, unit: group.unit }));
  return {
    prefix: group.prefix, name: group.name, emergency_stop: group.emergency_stop, axes: list,
    model: urdf?.name ?? "", category: matches ? category_of(list, urdf.is_linkage) : CATEGORY.other,
  };
}
