// SPDX-License-Identifier: Apache-2.0
// Answers of `indurop serve`, as tools/serve/openapi.json and docs/serve.md describe them, without fields that are not used.

export interface Range {
  min: number | null;
  max: number | null;
}

export interface Field {
  name: string;
  offset: number;
  type: Form;
  unit?: string;
  description?: string;
  range?: Range | null;
}

export interface Form {
  kind: "bool" | "char" | "i8" | "u8" | "i16" | "u16" | "i32" | "u32" | "i64" | "u64" | "f32" | "f64" | "text" | "enum" | "struct"
    | "wide_text" | "instance" | "reference";  // of local variables of PLC programs
  name?: string;
  size: number;  // bytes of one element
  dims?: number[];
  fields?: Field[];
  enumerators?: Record<string, number>;
  // Of local variables of PLC programs:
  iec?: string;  // "TIME"
  low?: number[];  // first index of each dimension
  range?: Range | null;
  unsigned?: boolean;  // an enum
  instance?: number;  // of a function block: its type in PlcDescription
}

export interface VariableDescription {
  name: string;
  type: string;
  form: Form;
  unit: string;
  range: Range | null;
  description: string;
  writers?: string[] | null;  // modules; null: not known
  readers?: string[] | null;
  taped?: boolean;  // its values of all runs can be followed; absent in a server of an earlier release
}

export interface VariableList {
  board: string;
  layout: string;
  variables: VariableDescription[];
}

export interface RobotDescription {
  module: string;
  urdf: string;  // text of the file
}

export interface ModuleDescription {
  name: string;
  operation: string;
  period_ns: number;
  priority: number;
}

export interface PlcVariable {
  name: string;
  section: "input" | "output" | "in_out" | "local" | "external";
  type: Form;
  offset?: number;  // from the begin of the instance; absent: the value is not reported
  variable?: string;  // the shared variable that it is
  step?: boolean;
  retain?: boolean;
  non_retain?: boolean;
  description?: string;
}

export interface PlcType {
  name: string;
  kind: "program" | "block" | "library";
  base?: number;
  size: number;
  variables: PlcVariable[];
}

export interface PlcInstance {
  name: string;
  task: number;
  type: number;
  variable: string;
  mark: string;
  offset: number;
}

// Of a program that was given with `--plc` and that the board runs.
export interface PlcDescription {
  program: string;
  programs: string[];  // all that were given
  tasks: { name: string; module: string; single?: string }[];
  instances: PlcInstance[];
  types: PlcType[];
  globals: string[];
}

export interface StreamBoard {
  board: string;
  alive: boolean;
  layout: string;
}

export interface Subscribed {
  id: number;
  stream: number;
  board: string;
  layout: string;
  record_size: number;
  quality_offset: number;
  variables: { name: string; offset: number }[];
}

export interface ServerStatus {
  version: string;
  write: boolean;
  users: boolean;
}

// Times are texts: see get_exact().
export interface PastValue {
  time_ns: string;
  bytes: string;  // hexadecimal
}

export interface PastVariable {
  before: PastValue | null;
  values: PastValue[];
  gaps: { from_ns: string; to_ns: string }[];
}

export interface HistoryPage {
  layout: string;
  end_ns: string;
  next: string | null;
  variables: PastVariable[];
}

export interface FunctionDescription {
  name: string;
  description: string;
  arguments: { name: string; form: Form; unit: string; description: string }[];
  result: Form | null;  // null: none
  served: boolean;
}

export interface Client {
  user: string;
  role: "unknown" | "look" | "operate" | "tune" | "program" | "administer";
}

export interface Alarm {
  alarm: string;
  name: string;
  text: string;
  priority: "critical" | "high" | "medium" | "low";
  condition: string;
  state: "normal" | "unacknowledged" | "acknowledged" | "returned" | "shelved";
  since_wall_ns?: number;
  value?: string;
  who?: string;
  reason?: string;
}
