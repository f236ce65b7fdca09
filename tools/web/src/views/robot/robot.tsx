// SPDX-License-Identifier: Apache-2.0
// The arm at its measured position, the path of its tool, and the status in numbers.

import { useEffect, useRef, useState } from "preact/hooks";
import { board_path, get, message_of, RequestError } from "../../api/http";
import type { Module, Robot as Description, Variables } from "../../api/types";
import { NoBoard } from "../../shell/no_board";
import { useBoard, useMay } from "../../shell/plant";
import { colours_changed } from "../../shell/theme";
import { address, change_query, place } from "../../ui/address";
import { Fact, DataTable, Waiting } from "../../ui/parts";
import { useRequest, useStore } from "../../ui/store";
import { Calibration } from "./calibration";
import { Guiding } from "./guiding";
import { Jog } from "./jog";
import { Question } from "./question";
import type { Scene } from "./scene";
import { end_of_scale, SCALE_STYLE } from "./speeds";
import { type Carried, scopes_of, useCarried, useRobotState, useUsed, useWays, VARIABLES, type RobotState, type Scope, type Way } from "./state";
import { way_out } from "./way_out";

const PURPOSE = "This view draws a robot arm at its current position with the path of its tool, shows its job and its axes, and jogs it.";
const MODULES_MS = 1000;
const VIEWS = ["Corner", "Front", "Side", "Top"];

interface Robots {
  robots: Description[];
  scopes: Scope[];
  described: boolean;  // the server provides descriptions of robots
}

function name_in(urdf: string): string {
  return /<robot[^>]*\sname\s*=\s*["']([^"']*)["']/.exec(urdf)?.[1] ?? "";
}

async function fetch_robots(board: string): Promise<Robots> {
  const called = (name: string) => get<Variables>(board_path(board, `/variables?values=false&match=*${name}`));
  const found = await Promise.all(VARIABLES.map(called));
  const scopes = scopes_of(found.flatMap(({ variables }) => variables));
  try {
    const { robots } = await get<{ robots: Description[] }>(board_path(board, "/robots"));
    return { robots: robots.map((robot) => ({ ...robot, name: name_in(robot.urdf) || robot.module })), scopes, described: true };
  } catch (error) {
    if (error instanceof RequestError && error.status === 404) return { robots: [], scopes, described: false };
    throw error;
  }
}

function fixed(value: number | undefined, digits: number, unit: string): string {
  if (value === undefined || !Number.isFinite(value)) return "-";
  const text = value.toFixed(digits);
  return `${Number(text) === 0 ? text.replace("-", "") : text} ${unit}`;
}

// "palletise, in part, " if a job that it called is running.
function job_text(state: RobotState): string {
  return state.job_called === state.job ? `${state.job}, ` : `${state.job}, in ${state.job_called}, `;
}

// "clear, eject and 2 more".
function pending_text({ pending, pending_count }: RobotState): string {
  const more = pending_count - pending.length;
  return more > 0 ? `${pending.join(", ")} and ${more} more` : pending.join(", ");
}

// Why the robot task does not run, as text; empty: it does.
function why_down(alive: boolean, scope: Scope | null, modules: Module[] | null): string {
  if (!alive) return "The node is not running";
  const down = modules?.find(({ name, state }) => scope?.modules.includes(name) && state !== "running");
  return down ? `Module ${down.name} is ${down.state === "faulted" ? `out of service (${down.last_fault})` : down.state}` : "";
}

function Reasons({ state }: { state: RobotState }) {
  const failed = state.job_state === "failed";
  const next = way_out(state);
  if (!state.error && !(failed && state.job_message)) return null;
  return (
    <>
      <p class="bad">{[state.error, state.job_message].filter(Boolean).join(": ")}</p>
      {next && <p class="why warn">{next}</p>}
    </>);
}

function Numbers({ state, names, down }: { state: RobotState; names: string[]; down: string }) {
  const { position, orientation } = state;
  return (
    <>
      {down && <p class="bad">{down}: the values below are its last ones.</p>}
      <dl class="facts">
        <Fact name="State" value={down ? "not running" : state.waits_for ? `${state.group}, waits for ${state.waits_for}` : state.group} bad={!!down || state.group.includes("error")} warn={state.group === "disabled"} />
        <Fact name="Job" value={state.job ? `${job_text(state)}line ${state.job_line}: ${down ? "not running" : state.job_state}` : "none"} bad={!!down || state.job_state === "failed"} />
        {state.interrupted.length > 0 && <Fact name="Interrupted" value={state.interrupted.join("; ")} hint="jobs that ON has interrupted; the last one continues first" />}
        {state.pending_count > 0 && <Fact name="Pending interrupts" value={pending_text(state)} hint="jobs that will be called, in this order" />}
        <Fact name="Tool speed" value={down ? "-" : fixed(state.tool_speed, 0, "mm/s")} />
        <Fact name="Effective override" value={down ? "-" : fixed(state.override_now, 0, "%")} hint="current speed in percent of the programmed speed, after override, job and hold" />
        <Fact name="Time remaining" value={down ? "-" : fixed(state.remaining_s, 1, "s")} />
        {["x", "y", "z"].map((name, i) => <Fact key={name} name={`Tool ${name}`} value={fixed(position[i], 1, "mm")} />)}
        {["roll", "pitch", "yaw"].map((name, i) => <Fact key={name} name={`Tool ${name}`} value={fixed(orientation[i], 1, "deg")} />)}
      </dl>
      <Reasons state={state} />
      <DataTable label="Axes">
        <thead><tr><th scope="col">Axis</th><th scope="col" class="number">Measured</th><th scope="col" class="number">Commanded</th><th scope="col" class="number">Speed</th></tr></thead>
        <tbody>
          {state.joint.map((joint, i) => (
            <tr key={i}><th scope="row">{names[i] ?? `axis ${i + 1}`}</th><td class="number">{fixed(joint, 2, "deg")}</td>
              <td class="number">{fixed(state.command[i], 2, "deg")}</td><td class="number">{down ? "-" : fixed(state.speed[i], 1, "deg/s")}</td></tr>))}
        </tbody>
      </DataTable>
    </>);
}

interface Drawn {
  scene: Scene;
  names: string[];
  kinds: string[];
  ahead?: { ways: Way[]; fastest: number };  // drawn last
  carried?: Carried | null;
  counts?: number[];
}

// Drawing needs far more code than the rest of the page: it is loaded when a robot is shown.
function useScene(robot: Description | null): { box: { current: HTMLDivElement | null }; drawn: { current: Drawn | null }; names: string[]; problem: string } {
  const box = useRef<HTMLDivElement>(null);
  const drawn = useRef<Drawn | null>(null);
  const [names, set_names] = useState<string[]>([]);
  const [problem, set_problem] = useState("");
  const colours = useStore(colours_changed);
  useEffect(() => {
    if (!robot) return;
    let ended = false;
    void import("./scene").then(({ Scene }) => {
      if (ended || !box.current) return;
      const scene = new Scene(box.current);
      const { axes } = scene.load(robot);
      drawn.current = { scene, names: axes.map(({ name }) => name), kinds: axes.map(({ jointType }) => jointType) };
      set_names(drawn.current.names);
      set_problem("");
    }).catch((error) => set_problem(`The arm cannot be drawn: ${message_of(error)}`));
    return () => {
      ended = true;
      drawn.current?.scene.end();
      drawn.current = null;
    };
  }, [robot]);
  useEffect(() => drawn.current?.scene.recolour(), [colours]);
  return { box, drawn, names, problem };
}

function has_zones({ zones = [], bodies = [], workspace = [] }: Description): boolean {
  return zones.length + bodies.length + workspace.length > 0;
}

function has_frames({ work_frames = [], belts = [], pallets = [] }: Description): boolean {
  return work_frames.length + belts.length + pallets.length > 0;
}

// Converts degrees and millimetres of the robot task to radians and metres of URDF.
function in_urdf(values: number[], kinds: string[]): number[] {
  return values.map((value, i) => (kinds[i] === "prismatic" ? value / 1000 : value * Math.PI / 180));
}

export function Robot() {
  const board = useBoard();
  const may_operate = useMay("operate");
  const may_tune = useMay("tune");
  const chosen = Number(useStore(place).query.get("r")) || 0;
  const { value, error } = useRequest(board ? `${board.board} ${board.layout}` : "", 0, () => fetch_robots(board!.board));
  const count = Math.max(value?.robots.length ?? 0, value?.scopes.length ?? 0);
  const index = Math.min(chosen, Math.max(0, count - 1));
  const robot = value?.robots[index] ?? null;
  const found = value ? value.scopes[index] ?? null : null;
  const scope = found && found.name;
  const modules = useRequest(board && found ? `${board.board} modules` : "", MODULES_MS,
    () => get<{ modules: Module[] }>(board_path(board!.board, "/modules")));
  const { box, drawn, names, problem } = useScene(robot);
  const [fastest, set_fastest] = useState(0);  // the end of the scale, which only grows while the robot moves
  const ahead = useRef<{ ways: Way[]; fastest: number }>({ ways: [], fastest: 0 });
  const carried = useRef<Carried | null>(null);
  const counts = useRef<number[]>([]);  // of places of pallets in use
  // The arm may be loaded later than the first of them arrive.
  const draw = () => {
    const now = drawn.current;
    if (now && now.ahead !== ahead.current) {
      now.ahead = ahead.current;
      now.scene.set_ways(now.ahead.ways, now.ahead.fastest);
    }
    if (now && carried.current && now.carried !== carried.current) {
      now.carried = carried.current;
      now.scene.carry(now.carried);
    }
    if (now && now.counts !== counts.current) {
      now.counts = counts.current;
      now.scene.use(now.counts);
    }
  };
  const state = useRobotState(board?.board ?? "", found, ({ joint, position, tool }) => {
    const now = drawn.current;
    draw();
    if (now) now.scene.move(in_urdf(joint.length ? joint : [], now.kinds), position, tool);
  });
  useWays(board?.board ?? "", found, (ways) => {
    const most = ways.length ? end_of_scale(Math.max(...ways.flatMap(({ speeds }) => speeds))) : 0;
    ahead.current = { ways, fastest: ways.length ? Math.max(ahead.current.fastest, most) : 0 };
    set_fastest(ahead.current.fastest);
    draw();
  });
  useCarried(board?.board ?? "", found, (now) => {
    carried.current = now;
    draw();
  });
  const used = useUsed(board?.board ?? "", robot, (now) => {
    counts.current = now;
    draw();
  });
  const [frames, set_frames] = useState(true);
  const show_frames = (shown: boolean) => {
    set_frames(shown);
    drawn.current?.scene.show_frames(shown);
  };
  const [zones, set_zones] = useState(true);
  const show_zones = (shown: boolean) => {
    set_zones(shown);
    drawn.current?.scene.show_zones(shown);
  };
  const down = why_down(board?.alive ?? true, found, modules.value?.modules ?? null);
  if (!board) return <NoBoard purpose={PURPOSE} />;
  if (!value) return error ? <p class="bad">{error}</p> : <Waiting />;
  if (count === 0) {
    return (
      <div class="panel">
        <p>{PURPOSE}</p>
        <p class="quiet">There is no robot on {board.board}: no module has a property <code>urdf</code>, and there is no variable ROBOT_ARM.</p>
      </div>);
  }
  return (
    <>
      {count > 1 && (
        <div class="bar"><label class="choice">Robot{" "}
          <select value={index} onChange={(event) => change_query({ r: event.currentTarget.value })}>
            {Array.from({ length: count }, (_, i) => <option key={i} value={i}>{value.robots[i]?.name ?? value.scopes[i]?.name}</option>)}
          </select></label></div>)}
      <div class="robot">
        {robot ? (
          <section class="panel" aria-label="The arm">
            <h2>{robot.name}</h2>
            <div class={`arm ${down ? "old" : ""}`} ref={box} role="img" aria-label={`The arm ${robot.name} at its ${down ? "last" : "current"} position; the table has the numbers`} />
            {problem && <p class="warn">{problem}</p>}
            <div class="bar">
              {VIEWS.map((view) => <button key={view} type="button" onClick={() => drawn.current?.scene.set_view(view)}>{view}</button>)}
              <button type="button" aria-label="Zoom in" onClick={() => drawn.current?.scene.zoom(0.8)}>+</button>
              <button type="button" aria-label="Zoom out" onClick={() => drawn.current?.scene.zoom(1.25)}>{"\u2212"}</button>
              <button type="button" onClick={() => drawn.current?.scene.clear_path()}>Clear path</button>
              {has_zones(robot) && <button type="button" aria-pressed={zones} onClick={() => show_zones(!zones)}>Zones</button>}
              {has_frames(robot) && <button type="button" aria-pressed={frames} onClick={() => show_frames(!frames)}>Frames</button>}
            </div>
            {fastest > 0 && <p class="speeds">Planned path: 0 <span class="scale" style={{ background: SCALE_STYLE }} /> {fastest} mm/s</p>}
            {(robot.pallets ?? []).map(({ name, places }, i) => (
              <p key={name} class="quiet">Pallet {name}: {Number.isFinite(used[i]) ? `${used[i]} of ${places.length} places used` : `${places.length} places`}</p>))}
            {robot.problem && <p class="warn">Not everything around the arm is shown: {robot.problem}</p>}
          </section>
        ) : (
          <p class="panel warn">{value.described ? "The arm's description (property urdf of its module) cannot be read, so only numbers are shown." : "This server does not provide the arm's description, so only numbers are shown."}</p>)}
        <div>
        {scope !== null && <Question board={board.board} scope={scope} down={down} may_answer={may_operate} />}
        {may_operate && scope !== null && <Jog board={board.board} scope={scope} state={state} down={down} names={names} work_frames={robot?.frames ?? []}
          positioner={robot?.urdf.includes("<workpiece") ?? false} />}
        {may_operate && found?.guides && robot && <Guiding board={board.board} module={robot.module} scope={found.name} state={state} down={down} may_write={may_tune} />}
        {may_tune && scope !== null && robot && <Calibration board={board.board} module={robot.module} scope={scope} state={state} down={down} work_frames={robot.frames} />}
        <section class="panel" aria-label="Robot in numbers">
          <h2>{down ? "Last values" : "Current values"}</h2>
          {state ? <Numbers state={state} names={names} down={down} /> : <Waiting />}
          {scope !== null && <p><a href={address("plots", {
            board: board.board, c: (state?.joint ?? []).map((_, i) => `${scope ? `${scope}::` : ""}ROBOT_ARM.joint[${i}]`).join(",") })}>Plot the axes</a></p>}
        </section>
        </div>
      </div>
    </>);
}
