// SPDX-License-Identifier: Apache-2.0
// Jogging: the robot moves while a button is held down. It stops when the button is released or the server receives nothing
// from this page. Override, hold and stop are next to the buttons.

import { useEffect, useRef, useState } from "preact/hooks";
import { board_path, message_of, post } from "../../api/http";
import { SERVICE } from "./names";
import { Press } from "./press";
import type { RobotState } from "./state";

const FRAMES: [string, string][] = [
  ["axes", "Axes"],
  ["base", "Tool, base frame"],
  ["tool", "Tool, tool frame"],
];
const DIRECTIONS = ["x", "y", "z", "roll", "pitch", "yaw"];
const BUSY = ["moving", "homing", "stopping"];

// Why the robot cannot be jogged, as text with what to do; empty: it can.
function why_not(state: RobotState | null, down: string): string {
  if (down) return `${down}: the robot cannot be jogged. Start it on the overview.`;
  if (!state) return "The status of the robot has not been received yet.";
  if (state.automatic) return "Automatic mode: the robot cannot be jogged.";
  if (!state.may_move) return "The robot cannot move: the enabling device is not pressed, or the operating mode does not allow it.";
  if (state.group === "disabled") return "The drives are disabled. The PLC program enables them when it starts the robot; or press Enable here.";
  if (state.group.includes("error")) return "An error stopped the group. Remove the cause, then press Reset here or reset it with the PLC program.";
  if (state.group !== "standby") return `The group is ${state.group}. It can be jogged in standby.`;
  return "";
}

interface Props {
  board: string;
  scope: string;
  state: RobotState | null;
  down: string;  // why the robot task does not run; empty: it runs
  names: string[];
  work_frames: string[];
  positioner: boolean;  // axes move the workpiece, and the base frame with it
}

export function Jog({ board, scope, state, down, names, work_frames, positioner }: Props) {
  const [frame, set_frame] = useState("axes");
  const [speed, set_speed] = useState(10);
  const [message, set_message] = useState("");
  const [held, set_held] = useState("");
  const [override_requested, set_override_requested] = useState<number | null>(null);  // not reported by the robot task yet
  const pressed = useRef<Press | null>(null);
  const release = () => {
    pressed.current?.end();
    pressed.current = null;
    set_held("");
  };
  // When the page loses the pointer, the focus or the user, the button counts as released.
  useEffect(() => {
    const release_if_hidden = () => { if (document.hidden) release(); };
    const all: [EventTarget, string, () => void][] = [
      [window, "blur", release], [window, "pagehide", release], [window, "pointerup", release], [window, "pointercancel", release], [document, "visibilitychange", release_if_hidden]];
    for (const [target, what, act] of all) target.addEventListener(what, act);
    return () => {
      for (const [target, what, act] of all) target.removeEventListener(what, act);
      release();
    };
  }, [board, scope, frame]);
  const reason = why_not(state, down);
  const off = reason !== "" && held === "";  // while a button is held, the group is moving
  useEffect(() => { if (down) release(); }, [down]);
  const press = (index: number, sign: number) => {
    release();
    if (off) return set_message(reason);
    set_message("");
    const one = new Press(board, (text) => { set_message(text); set_held(""); });
    pressed.current = one;
    set_held(`${index} ${sign}`);
    const directions = frame === "axes" ? state?.joint.length ?? 6 : 6;
    void one.begin({ robot: scope, frame, speed: Array.from({ length: directions }, (_, i) => (i === index ? sign * speed : 0)) });
  };
  const write = async (values: Record<string, unknown>, success: string): Promise<void> => {
    try {
      await post(board_path(board, "/set"), { values: Object.fromEntries(Object.entries(values).map(([name, value]) => [`${scope ? `${scope}::` : ""}${name}`, value])), reason: success });
      set_message(success);
    } catch (error) {
      set_override_requested(null);
      set_message(message_of(error));
    }
  };
  const request_service = (opcode: number, success: string) =>
    void write({ ROBOT_MODULE_SERVICE: `{eOpCode: ${opcode}, nRequest: ${(state?.acknowledged ?? 0) + 1}}` }, success);
  const axes = frame === "axes" ? (state?.joint ?? []).map((_, i) => names[i] ?? `axis ${i + 1}`) : DIRECTIONS;
  const frames = [...FRAMES, ...(positioner ? [["world", "Tool, world frame"] as [string, string]] : []), ...work_frames.map((name): [string, string] => [name, `Tool, frame ${name}`])];
  const override = override_requested ?? (Number.isFinite(state?.override_set) ? state!.override_set : 100);
  useEffect(() => set_override_requested((now) => (now === state?.override_set ? null : now)), [override_requested, state?.override_set]);
  const button = (index: number, sign: number, name: string) => (
    <button type="button" class={`jog ${held === `${index} ${sign}` ? "main" : off ? "off" : ""}`} aria-disabled={off} aria-label={`${name} ${sign > 0 ? "forward" : "back"}, while held down`}
      onPointerDown={(event) => { if (event.button === 0) { event.currentTarget.releasePointerCapture?.(event.pointerId); press(index, sign); } }}
      onPointerLeave={release} onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => { if (event.key === " " && !event.repeat) { event.preventDefault(); press(index, sign); } }}
      onKeyUp={release} onBlur={release}>{sign > 0 ? "+" : "\u2212"}</button>);
  return (
    <section class="panel" aria-label="Jogging">
      <h2>Jogging</h2>
      {reason && !held && <p class={`why ${!down && BUSY.includes(state?.group ?? "") ? "quiet" : "warn"}`}>{reason}</p>}
      <fieldset disabled={!!down}>
      <div class="bar">
        <button type="button" class="stop" onClick={() => {
          release();
          request_service(state?.job_state === "running" || state?.job_state === "waiting" ? SERVICE.job_stop : SERVICE.stop, "Stopped.");
        }}>Stop</button>
        <button type="button" aria-pressed={state?.hold ?? false} onClick={() => void write({ ROBOT_HOLD: state?.hold ? 0 : 1 }, state?.hold ? "Resumed." : "Held.")}>
          {state?.hold ? "Resume" : "Hold"}</button>
        <label>Override {override} % <input type="range" aria-label="Override" min={0} max={100} step={5} value={override}
          onInput={(event) => set_override_requested(Number(event.currentTarget.value))}
          onChange={(event) => void write({ ROBOT_OVERRIDE: Number(event.currentTarget.value) }, `Override ${event.currentTarget.value} %.`)} /></label>
      </div>
      {!down && state?.group === "disabled" && <p><button type="button" class="main" onClick={() => request_service(SERVICE.enable, "Enabling was requested.")}>Enable</button></p>}
      {!down && state?.group.includes("error") && <p><button type="button" class="main" onClick={() => request_service(SERVICE.reset, "A reset was requested.")}>Reset</button></p>}
      <div class="bar">
        <label>Jog <select value={frame} onChange={(event) => set_frame(event.currentTarget.value)}>
          {frames.map(([name, title]) => <option key={name} value={name}>{title}</option>)}</select></label>
        <label>Speed {speed} % <input type="range" aria-label="Jog speed" min={1} max={100} value={speed} onInput={(event) => set_speed(Number(event.currentTarget.value))} /></label>
      </div>
      <ul class="plain jogs">
        {axes.map((name, i) => <li key={name}>{button(i, -1, name)} <span>{name}</span> {button(i, 1, name)}</li>)}
      </ul>
      </fieldset>
      <p role="status" class="warn">{message}</p>
      <p class="quiet">The robot moves while a button, or the space bar on it, is held down, at most at 250 mm/s. This is not a safety function: keep the emergency stop within reach.</p>
    </section>);
}
