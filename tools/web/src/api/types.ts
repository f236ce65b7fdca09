// SPDX-License-Identifier: Apache-2.0
// Answers of the server, as tools/serve/openapi.json and docs/serve.md describe them, without fields that the page does not use.

export type Quality = "good" | "stale" | "silent" | "unread";

// What a client may do; each role includes those before it.
export const ROLES = ["unknown", "look", "operate", "tune", "program", "administer"] as const;
export type Role = typeof ROLES[number];

export interface ServerStatus {
  version: string;
  api: string;
  write: boolean;
  may_write: boolean;
  who: string;
  role: Role;
  users: boolean;  // users can sign in
  max_rate_hz: number;
  plant: boolean;
  plc: boolean;
}

export interface BoardSummary {
  board: string;
  here: boolean;  // on this host
  host?: string;  // of a remote board
  alive: boolean;
  state: string;
  deployment: string;
  config_file: string;
  modules: number;
  overruns: number;
  faults: number;
  forces: number;
  alarms: AlarmCounts;
  trouble: string[];
  layout: string;
}

export interface PlcNetwork {
  number: number;
  remarks: string[];
  svg: string;
  width: number;
  height: number;
  rail: boolean;
  wires: [number, number, number, number][];
  switches: { x: number; y: number; name: string; coil: boolean }[];
  values: [number, number][];
}

export interface PlcChart {
  svg: string;
  width: number;
  height: number;
  steps: { name: string; box: [number, number, number, number] }[];
  conditions: string[];
}

export interface PlcBody {
  title: string;
  action: string;
  language: string;
  networks?: PlcNetwork[];
  chart?: PlcChart;
  lines?: string[];
}

export interface PlcProgram {
  program: string;
  programs: string[];
  namespace: string;
  others: string;
  bodies: PlcBody[];
}

export interface PlcNetworkLive {
  power: string;
  closed: string;
  values: string[];
}

export interface PlcBodyLive {
  networks?: PlcNetworkLive[];
  active?: string;
  times?: string[];
  conditions?: string[];
  values?: string[];
}

export interface PlcLive {
  alive: boolean;
  bodies: PlcBodyLive[];
}

export interface RecordingFile {
  name: string;
  node: string;
  reason: string;
  black_box: boolean;
  bytes: number;
  wall_ns: number;
}

export interface RecordingContents extends RecordingFile {
  begin_ns: number;
  end_ns: number;
  complete: boolean;
  boards: string[];  // whose recordings were joined; empty: of one node
  channels: { name: string; unit: string; numbers: string[] }[];
}

// One tick of a recording.
export interface RecordedTick {
  tick: number;
  previous: number | null;
  next: number | null;
  begin_ns: number;
  end_ns: number;
  runs: {
    module: string; number: number; release_ns: number; start_ns: number; end_ns: number; faulted: boolean;
    values: { name: string; written: boolean; text: string }[];
  }[];
  numbers: { name: string; value: number | null }[];
}

// What modules kept after a tick of a recording, from a replay.
export interface ReplayedTick {
  tick: number;
  differing: number;
  messages: string[];
  modules: {
    module: string; state: "known" | "doubtful" | "unknown"; reason: string; by_functions: boolean;
    kept: { name: string; type: string; value: string }[];
  }[];
}

export interface RecordedValues {
  begin_ns: number;
  end_ns: number;
  lines: { name: string; values: (number | null)[] }[];
}

export interface RemoteBoard {
  board: string;
  host: string;
  state: string;
  phase: string;
  plant: string;
  deployment: string;
  release: string;
  tick: number;
  lost_ticks: number;
  overruns: number;
  faults: number;
  message: string;
  heard: boolean;
  age_ns: number;
}

export interface PlantNow {
  domain: number;
  problem: string;
  trouble: string[];
  boards: RemoteBoard[];
  not_heard: string[];
}

export interface Deployment {
  generation: number;
  current: boolean;
  deployment: string;
  plant: string;
  wall_ns: number;
  host: string;
  boards: string[];
  outcome: string;
}

export interface ChangedFile {
  path: string;
  change: "added" | "removed" | "changed";
  size_before: number | null;
  size_after: number | null;
  lines: { change: "added" | "removed" | "same"; text: string }[];
}

export interface Force {
  name: string;
  value: unknown;
  left_ns: number | null;
  who?: string;
  from?: string;
  reason?: string;
  lease?: boolean;
}

export interface Lock {
  lock: "none" | "tune" | "all";
  who?: string;
  from?: string;
  reason?: string;
}

// Fields beyond these are those of `indurop status -o json`.
export interface Board {
  node: string;
  alive: boolean;
  state: string;
  forces: Force[];
  trouble: string[];
  [more: string]: unknown;
}

export interface Module {
  name: string;
  type: string;
  operation: string;
  period_ns: number;
  priority: number;
  core?: number;
  offset_ns?: number;
  deadline_ns?: number;
  state: string;
  runs: number;
  skipped: number;
  overruns: number;
  deadline_misses: number;
  restarts: number;
  last_exec_ns?: number;
  mean_exec_ns?: number;
  max_exec_ns?: number;
  jitter_p50_ns?: number;
  jitter_p99_ns?: number;
  jitter_max_ns?: number;
  last_fault: string;
}

export interface Fault {
  severity: "error" | "warning" | "note";
  module: string;
  text: string;
  tick?: number;
}

export interface AlarmCounts {
  active: number;
  unacknowledged: number;
  shelved: number;
  worst: Priority | null;
}

export type Priority = "critical" | "high" | "medium" | "low";

export interface Alarm {
  alarm: string;
  name: string;
  text: string;
  priority: Priority;
  condition: string;
  unit: string;
  delay_ns: number;
  state: "normal" | "unacknowledged" | "acknowledged" | "returned" | "shelved";
  count: number;
  since_wall_ns?: number;
  value?: string;
  who?: string;
  reason?: string;
  until_wall_ns?: number;
}

export interface Alarms {
  watched: boolean;
  declared: number;
  counts: AlarmCounts;
  alarms: Alarm[];
}

export interface Recipe {
  recipe: string;
  comment: string;
  who: string;
  saved_wall_ns: number;
  values: number;
}

export interface RecipeValues {
  recipe: string;
  values: { name: string; recipe: unknown; now: unknown; same: boolean }[];
}

// A message that a module or the node printed.
export interface Message {
  who: string;
  tick: number;
  time_ns: number;
  text: string;
}

export interface AlarmEvent {
  wall_ns: number;
  alarm: string;
  event: string;
  text: string;
  priority: Priority;
  value?: string;
  who?: string;
  reason?: string;
}

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

// The form of a variable's bytes.
export interface Form {
  kind: string;
  name?: string;
  size: number;
  dims?: number[];
  fields?: Field[];
  enumerators?: Record<string, number>;
}

export interface Variable {
  name: string;
  type: string;
  form: Form;
  value?: unknown;
  text?: string;
  unit: string;
  range: Range | null;
  retain: boolean;
  writers: string[] | null;
  readers: string[] | null;
  description: string;
  source: string;
  age_ns: number | null;
  quality: Quality;
  forced: string[];
}

export interface Variables {
  board: string;
  layout: string;
  alive: boolean;
  uses_known: boolean;
  variables: Variable[];
}

export interface Run {
  number: number;
  tick: number;
  slot: number;
  module: string;
  release_ns: number;
  start_ns: number;
  end_ns: number;
}

export interface Runs {
  epoch_ns: number;
  now_ns: number;
  next: number;
  runs: Run[];
}

export interface Overrun {
  number: number;
  tick: number;
  slot: number;
  module: string;
  own_ns: number;
  latency_ns: number;
  previous: string;
  previous_ns: number;
  started: boolean;
}

export interface Schedule {
  basic_period_ns: number;
  macro_period_ns: number;
  slots: number;
  epoch_ns: number;
  message: string;
}

export interface Histogram {
  count: number;
  min_ns: number;
  max_ns: number;
  mean_ns: number;
  p50_ns: number;
  p99_ns: number;
  bins: [number, number, number][];
}

// A zone that the arm keeps out of, in the frame of the base; or part of a tool, in that of the arm's end.
export interface RobotBody {
  name: string;
  tool?: number;
  kind: "box" | "cylinder" | "ball";
  size: number[];  // mm
  position: number[];
  orientation: number[];  // deg, roll pitch yaw
}

// A work frame, in the frame of the base.
export interface WorkFrame {
  name: string;
  position: number[];  // mm
  orientation: number[];  // deg, roll pitch yaw
  computed: boolean;  // jobs compute it: this is where the files declare it
  points: { name: string; position: number[] }[];  // mm, in the frame of the base
}

// A belt or a table that jobs track.
export interface Belt {
  number: number;
  turns: boolean;
  along: string;
  part: string;
  length: number;  // mm; 0: not known
}

export interface Pallet {
  name: string;
  frame: string;
  orientation: number[];  // deg, roll pitch yaw
  size: number[];  // mm from place to place along x, y, z of the frame; 0: there is one
  used: string;  // variable with the number of places in use
  places: number[][];  // mm, in the frame of the base, in the order in which they are used
}

export interface Robot {
  module: string;
  urdf: string;
  frames: string[];
  work_frames?: WorkFrame[];
  belts?: Belt[];
  pallets?: Pallet[];
  zones?: RobotBody[];
  bodies?: RobotBody[];
  workspace?: number[];  // mm, two corners; empty: none
  problem?: string;  // why something around it is not known
  name?: string;  // added by the page, from the text
}

export interface Calibration {
  points: { mark: string; place: string; seen: string; off: number | null }[];  // off: mm
  wrong: string;  // why there is no result; empty: there is one
  next: string;
  next_mark: string;
  declaration: string;
  before: string;
  rms: number;  // mm, as the next one
  most: number;
  worst: number;  // from 1; 0: no result
  spare: number;
  turned: boolean;
  place_deviation: number[];  // mm
  turn_deviation: number[];  // deg
  scale: number;
}

// The path along which a hand guided a robot.
export interface GuidedPath {
  records: boolean;
  guided: boolean;
  places: number;
  marks: number;
  length: number;  // mm
  tool: string;
  problem: string;  // why recording ended early; empty: it did not
}

// The job that was written of it.
export interface WrittenPath {
  file: string;
  text: string;
  points: number;
  length: number;  // mm, as the next one
  deviation: number;
  turn_deviation: number;  // deg
  is_read: boolean;  // the robot reads this file
}

export interface CaptureLine {
  name: string;
  channel: string;
  unit: string;
  words?: string[];
  values: (number | null)[];
}

export interface Capture {
  period_ns: number;
  first_tick: number;
  first_wall_ns: number;
  rows: number;
  trigger: string;
  trigger_row: number | null;
  lost_runs: number;
  lines: CaptureLine[];
}

export interface StreamVariable {
  name: string;
  type: string;
  form: Form;
  offset: number;
  unit: string;
}

export interface Subscribed {
  type: "subscribed";
  id: number;
  stream: number;
  board: string;
  layout: string;
  rate_hz: number;
  binary: boolean;
  record_size: number;
  quality_offset: number;
  variables: StreamVariable[];
  missing?: { name: string; message: string }[];
}

export interface ValuesFrame {
  type: "values";
  stream: number;
  seq: number;
  time_ns: number;
  wall_ns: number;
  alive: boolean;
  full?: boolean;
  values: Record<string, unknown>;
  quality?: Record<string, Quality>;
  forced?: string[];
}

export interface StreamBoard {
  board: string;
  alive: boolean;
  state: string;
  layout: string;
}

// A user who may sign in.
export interface User {
  user: string;
  role: Role;
  boards: string[];     // patterns; empty: all
  variables: string[];  // patterns; empty: all
  password: boolean;    // has one
  token: boolean;       // has one
  sessions: { from: string; since_ns: number; idle_ns: number }[];
}

export interface AuditEntry {
  wall_ns: number;
  who: string;
  from: string;
  board: string;
  action: string;
  what: string;
  outcome: string;
  reason: string;
}
