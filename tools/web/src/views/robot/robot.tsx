// SPDX-License-Identifier: Apache-2.0
// The arm as it stands now, the way of its tool, and the same as numbers.

import { useEffect, useRef, useState } from "preact/hooks";
import { board_path, get, Refusal, words } from "../../api/http";
import type { Module, Robot as Description, Variables } from "../../api/types";
import { plant, useBoard } from "../../shell/plant";
import { colours_changed } from "../../shell/theme";
import { address, change_query, place } from "../../ui/address";
import { Figure, Figures, Waiting } from "../../ui/parts";
import { useAsked, useStore } from "../../ui/store";
import { Jog } from "./jog";
import type { Scene } from "./scene";
import { scopes_of, useRobotState, type RobotState, type Scope } from "./state";

const MODULES_MS = 1000;
const LOOKS = ["Corner", "Front", "Side", "Top"];

interface Known {
  robots: Description[];
  scopes: Scope[];
  told: boolean;  // the server has descriptions of robots
}

function name_in(urdf: string): string {
  return /<robot[^>]*\sname\s*=\s*["']([^"']*)["']/.exec(urdf)?.[1] ?? "";
}

async function ask(board: string): Promise<Known> {
  const variables = await get<Variables>(board_path(board, "/variables?values=false&match=*ROBOT_ARM"));
  const scopes = scopes_of(variables.variables);
  try {
    const { robots } = await get<{ robots: Description[] }>(board_path(board, "/robots"));
    return { robots: robots.map((robot) => ({ ...robot, name: name_in(robot.urdf) || robot.module })), scopes, told: true };
  } catch (error) {
    if (error instanceof Refusal && error.status === 404) return { robots: [], scopes, told: false };
    throw error;
  }
}

function fixed(value: number | undefined, digits: number, unit: string): string {
  if (value === undefined || !Number.isFinite(value)) return "-";
  const text = value.toFixed(digits);
  return `${Number(text) === 0 ? text.replace("-", "") : text} ${unit}`;
}

// "palletise, in part, " if a job that it called is running.
function called(state: RobotState): string {
  return state.job_called === state.job ? `${state.job}, ` : `${state.job}, in ${state.job_called}, `;
}

// Why the robot task does not run, in words; empty: it does.
function why_down(alive: boolean, scope: Scope | null, modules: Module[] | null): string {
  if (!alive) return "The node does not run";
  const down = modules?.find(({ name, state }) => scope?.modules.includes(name) && state !== "running");
  return down ? `Module ${down.name} is ${down.state === "faulted" ? `out of service (${down.last_fault})` : down.state}` : "";
}

function Reasons({ state }: { state: RobotState }) {
  const failed = state.job_state === "failed";
  if (!state.error && !(failed && state.job_message)) return null;
  return <p class="bad">{[state.error, state.job_message].filter(Boolean).join(": ")}</p>;
}

function Numbers({ state, names, down }: { state: RobotState; names: string[]; down: string }) {
  const { position, orientation } = state;
  return (
    <>
      {down && <p class="bad">{down}: these are its last numbers.</p>}
      <dl class="facts">
        <Figure name="State" value={down ? "does not run" : state.group} bad={!!down || state.group.includes("error")} warn={state.group === "no power"} />
        <Figure name="Job" value={state.job ? `${called(state)}line ${state.job_line}: ${down ? "does not run" : state.job_state}` : "none yet"} bad={!!down || state.job_state === "failed"} />
        <Figure name="Tool speed" value={down ? "-" : fixed(state.tool_speed, 0, "mm/s")} />
        <Figure name="Pace on its path" value={down ? "-" : fixed(state.override_now, 0, "%")} hint="What override, job and hold leave of the speed, at this moment" />
        <Figure name="To go" value={down ? "-" : fixed(state.to_go, 1, "s")} />
        {["x", "y", "z"].map((name, i) => <Figure key={name} name={`Tool ${name}`} value={fixed(position[i], 1, "mm")} />)}
        {["roll", "pitch", "yaw"].map((name, i) => <Figure key={name} name={`Tool ${name}`} value={fixed(orientation[i], 1, "deg")} />)}
      </dl>
      <Reasons state={state} />
      <Figures label="Axes">
        <thead><tr><th scope="col">Axis</th><th scope="col" class="number">Measured</th><th scope="col" class="number">Commanded</th><th scope="col" class="number">Speed</th></tr></thead>
        <tbody>
          {state.joint.map((joint, i) => (
            <tr key={i}><th scope="row">{names[i] ?? `axis ${i + 1}`}</th><td class="number">{fixed(joint, 2, "deg")}</td>
              <td class="number">{fixed(state.command[i], 2, "deg")}</td><td class="number">{down ? "-" : fixed(state.speed[i], 1, "deg/s")}</td></tr>))}
        </tbody>
      </Figures>
    </>);
}

interface Drawn {
  scene: Scene;
  names: string[];
  kinds: string[];
}

// The picture needs far more code than everything else: it is fetched when it is wanted.
function useScene(urdf: string | null): { box: { current: HTMLDivElement | null }; drawn: { current: Drawn | null }; names: string[]; said: string } {
  const box = useRef<HTMLDivElement>(null);
  const drawn = useRef<Drawn | null>(null);
  const [names, set_names] = useState<string[]>([]);
  const [said, say] = useState("");
  const colours = useStore(colours_changed);
  useEffect(() => {
    if (!urdf) return;
    let ended = false;
    void import("./scene").then(({ Scene }) => {
      if (ended || !box.current) return;
      const scene = new Scene(box.current);
      const { axes } = scene.load(urdf);
      drawn.current = { scene, names: axes.map(({ name }) => name), kinds: axes.map(({ jointType }) => jointType) };
      set_names(drawn.current.names);
      say("");
    }).catch((error) => say(`The arm cannot be drawn here: ${words(error)}`));
    return () => {
      ended = true;
      drawn.current?.scene.end();
      drawn.current = null;
    };
  }, [urdf]);
  useEffect(() => drawn.current?.scene.recolour(), [colours]);
  return { box, drawn, names, said };
}

// Degrees and millimetres of the robot task to what URDF has.
function in_urdf(values: number[], kinds: string[]): number[] {
  return values.map((value, i) => (kinds[i] === "prismatic" ? value / 1000 : value * Math.PI / 180));
}

export function Robot() {
  const board = useBoard();
  const { status } = useStore(plant);
  const chosen = Number(useStore(place).query.get("r")) || 0;
  const { value, error } = useAsked(board ? `${board.board} ${board.layout}` : "", 0, () => ask(board!.board), words);
  const count = Math.max(value?.robots.length ?? 0, value?.scopes.length ?? 0);
  const index = Math.min(chosen, Math.max(0, count - 1));
  const robot = value?.robots[index] ?? null;
  const found = value ? value.scopes[index] ?? null : null;
  const scope = found && found.name;
  const modules = useAsked(board && found ? `${board.board} modules` : "", MODULES_MS,
    () => get<{ modules: Module[] }>(board_path(board!.board, "/modules")), words);
  const { box, drawn, names, said } = useScene(robot?.urdf ?? null);
  const state = useRobotState(board?.board ?? "", scope, ({ joint }) => {
    const now = drawn.current;
    if (now) now.scene.move(in_urdf(joint.length ? joint : [], now.kinds));
  });
  const down = why_down(board?.alive ?? true, found, modules.value?.modules ?? null);
  if (!board || !value) return error ? <p class="bad">{error}</p> : <Waiting />;
  if (count === 0) {
    return (
      <div class="panel">
        <p>Here the arm is drawn as it stands, with the way of its tool, its job and its axes, and moved by hand.</p>
        <p class="quiet">There is no robot on {board.board}: no module with a property <code>urdf</code>, no variable ROBOT_ARM.</p>
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
            <div class={`arm ${down ? "old" : ""}`} ref={box} role="img" aria-label={`The arm ${robot.name} as it ${down ? "stood last" : "stands now"}; the numbers are in the table`} />
            {said && <p class="warn">{said}</p>}
            <div class="bar">
              {LOOKS.map((look) => <button key={look} type="button" onClick={() => drawn.current?.scene.look(look)}>{look}</button>)}
              <button type="button" aria-label="Nearer" onClick={() => drawn.current?.scene.nearer(0.8)}>+</button>
              <button type="button" aria-label="Farther" onClick={() => drawn.current?.scene.nearer(1.25)}>{"\u2212"}</button>
              <button type="button" onClick={() => drawn.current?.scene.forget_path()}>Forget the path</button>
            </div>
          </section>
        ) : (
          <p class="panel warn">{value.told ? "The arm's description (property urdf of its module) cannot be read here, so only numbers are shown." : "This server does not tell the arm's description, so only numbers are shown."}</p>)}
        <div>
        {status?.may_write && scope !== null && <Jog board={board.board} scope={scope} state={state} down={down} names={names} work_frames={robot?.frames ?? []} />}
        <section class="panel" aria-label="Robot in numbers">
          <h2>{down ? "Last seen" : "Now"}</h2>
          {state ? <Numbers state={state} names={names} down={down} /> : <Waiting />}
          {scope !== null && <p><a href={address("plots", {
            board: board.board, c: (state?.joint ?? []).map((_, i) => `${scope ? `${scope}::` : ""}ROBOT_ARM.joint[${i}]`).join(",") })}>Plot the joints</a></p>}
        </section>
        </div>
      </div>
    </>);
}
