// SPDX-License-Identifier: Apache-2.0
// The robot moved by hand: it moves while a button is held down, and stops when it is let go, or this page is not heard any
// more. Speed, hold and stop beside it.

import { useEffect, useRef, useState } from "preact/hooks";
import { board_path, post, post_at_the_end, words } from "../../api/http";
import type { RobotState } from "./state";
import { SERVICE } from "./words";

const FRAMES: [string, string][] = [
  ["axes", "Axes"],
  ["base", "Tool along the base"],
  ["tool", "Tool along itself"],
];
const DIRECTIONS = ["x", "y", "z", "roll", "pitch", "yaw"];
const BUSY = ["moving", "homing", "stopping"];
const KEEPS = 3;  // times within what the server waits

// One hand: what is held down, until it is let go or lost.
class Hand {
  private timer = 0;
  private path = "";
  private ended = false;

  constructor(private readonly board: string, private readonly say: (text: string) => void) {}

  async begin(robot: string, frame: string, speed: number[]): Promise<void> {
    try {
      const { jog, keep_ns } = await post<{ jog: string; keep_ns: number }>(board_path(this.board, "/jog"), { robot, frame, speed });
      this.path = board_path(this.board, `/jog/${jog}`);
      if (this.ended) return this.release();  // let go before the answer came
      this.timer = window.setInterval(() => void this.keep(), keep_ns / 1e6 / KEEPS);
    } catch (error) {
      this.ended = true;
      this.say(words(error));
    }
  }

  private async keep(): Promise<void> {
    try {
      await post(`${this.path}/keep`, undefined);
    } catch (error) {
      if (!this.ended) this.say(words(error));
      this.end();
    }
  }

  end(): void {
    if (this.ended) return;
    this.ended = true;
    clearInterval(this.timer);
    if (this.path) this.release();
  }

  private release(): void {
    post_at_the_end(`${this.path}/end`);
  }
}

// Why no button moves it, in words, and what to do; empty: they do.
function why_not(state: RobotState | null, down: string): string {
  if (down) return `${down}: the robot cannot be moved. Start it on the overview.`;
  if (!state) return "Nothing is known of it yet.";
  if (state.automatic) return "Automatic mode: the robot is not moved by hand.";
  if (!state.may_move) return "Nothing moves: the enabling switch is not held, or another mode was chosen.";
  if (state.group === "no power") return "The drives have no power. They get it from the PLC program, when it starts the robot, or from Power on here.";
  if (state.group.includes("error")) return "The group was stopped by an error. Once its cause is gone, reset it, here or with the PLC program.";
  if (state.group !== "standing by") return `The group is ${state.group}: it is moved by hand when it stands by.`;
  return "";
}

interface Props {
  board: string;
  scope: string;
  state: RobotState | null;
  down: string;  // why the robot task does not run; empty: it does
  names: string[];
  work_frames: string[];
}

export function Jog({ board, scope, state, down, names, work_frames }: Props) {
  const [frame, choose] = useState("axes");
  const [speed, set_speed] = useState(10);
  const [said, say] = useState("");
  const [held, hold] = useState("");
  const [wanted, want] = useState<number | null>(null);  // override that was chosen and is not told yet
  const hand = useRef<Hand | null>(null);
  const let_go = () => {
    hand.current?.end();
    hand.current = null;
    hold("");
  };
  // Whatever takes the page from the hand lets go.
  useEffect(() => {
    const away = () => { if (document.hidden) let_go(); };
    const all: [EventTarget, string, () => void][] = [
      [window, "blur", let_go], [window, "pagehide", let_go], [window, "pointerup", let_go], [window, "pointercancel", let_go], [document, "visibilitychange", away]];
    for (const [target, what, act] of all) target.addEventListener(what, act);
    return () => {
      for (const [target, what, act] of all) target.removeEventListener(what, act);
      let_go();
    };
  }, [board, scope, frame]);
  const refused = why_not(state, down);
  const off = refused !== "" && held === "";  // while it is held, it moves
  useEffect(() => { if (down) let_go(); }, [down]);
  const press = (index: number, sign: number) => {
    let_go();
    if (off) return say(refused);
    say("");
    const one = new Hand(board, (text) => { say(text); hold(""); });
    hand.current = one;
    hold(`${index} ${sign}`);
    const directions = frame === "axes" ? state?.joint.length ?? 6 : 6;
    void one.begin(scope, frame, Array.from({ length: directions }, (_, i) => (i === index ? sign * speed : 0)));
  };
  const order = async (values: Record<string, unknown>, what: string): Promise<void> => {
    try {
      await post(board_path(board, "/set"), { values: Object.fromEntries(Object.entries(values).map(([name, value]) => [`${scope ? `${scope}::` : ""}${name}`, value])), reason: what });
      say(what);
    } catch (error) {
      want(null);
      say(words(error));
    }
  };
  const serve = (opcode: number, what: string) =>
    void order({ ROBOT_MODULE_SERVICE: `{eOpCode: ${opcode}, nRequest: ${(state?.acknowledged ?? 0) + 1}}` }, what);
  const axes = frame === "axes" ? (state?.joint ?? []).map((_, i) => names[i] ?? `axis ${i + 1}`) : DIRECTIONS;
  const frames = [...FRAMES, ...work_frames.map((name): [string, string] => [name, `Tool along ${name}`])];
  const override = wanted ?? (Number.isFinite(state?.override_set) ? state!.override_set : 100);
  useEffect(() => want((now) => (now === state?.override_set ? null : now)), [wanted, state?.override_set]);
  const button = (index: number, sign: number, name: string) => (
    <button type="button" class={`jog ${held === `${index} ${sign}` ? "main" : off ? "off" : ""}`} aria-disabled={off} aria-label={`${name} ${sign > 0 ? "forward" : "back"}, while held down`}
      onPointerDown={(event) => { if (event.button === 0) { event.currentTarget.releasePointerCapture?.(event.pointerId); press(index, sign); } }}
      onPointerLeave={let_go} onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => { if (event.key === " " && !event.repeat) { event.preventDefault(); press(index, sign); } }}
      onKeyUp={let_go} onBlur={let_go}>{sign > 0 ? "+" : "\u2212"}</button>);
  return (
    <section class="panel" aria-label="Moving by hand">
      <h2>By hand</h2>
      {refused && !held && <p class={`why ${!down && BUSY.includes(state?.group ?? "") ? "quiet" : "warn"}`}>{refused}</p>}
      <fieldset disabled={!!down}>
      <div class="bar">
        <button type="button" class="stop" onClick={() => {
          let_go();
          serve(state?.job_state === "runs" || state?.job_state === "waits" ? SERVICE.job_stop : SERVICE.stop, "Stopped.");
        }}>Stop</button>
        <button type="button" aria-pressed={state?.hold ?? false} onClick={() => void order({ ROBOT_HOLD: state?.hold ? 0 : 1 }, state?.hold ? "Goes on." : "Held.")}>
          {state?.hold ? "Go on" : "Hold"}</button>
        <label>Override {override} % <input type="range" aria-label="Override" min={0} max={100} step={5} value={override}
          onInput={(event) => want(Number(event.currentTarget.value))}
          onChange={(event) => void order({ ROBOT_OVERRIDE: Number(event.currentTarget.value) }, `Override ${event.currentTarget.value} %.`)} /></label>
      </div>
      {!down && state?.group === "no power" && <p><button type="button" class="main" onClick={() => serve(SERVICE.enable, "Power is asked for.")}>Power on</button></p>}
      {!down && state?.group.includes("error") && <p><button type="button" class="main" onClick={() => serve(SERVICE.reset, "A reset is asked for.")}>Reset</button></p>}
      <div class="bar">
        <label>Moves <select value={frame} onChange={(event) => choose(event.currentTarget.value)}>
          {frames.map(([name, title]) => <option key={name} value={name}>{title}</option>)}</select></label>
        <label>at {speed} % <input type="range" aria-label="Speed by hand" min={1} max={100} value={speed} onInput={(event) => set_speed(Number(event.currentTarget.value))} /></label>
      </div>
      <ul class="plain jogs">
        {axes.map((name, i) => <li key={name}>{button(i, -1, name)} <span>{name}</span> {button(i, 1, name)}</li>)}
      </ul>
      </fieldset>
      <p role="status" class="warn">{said}</p>
      <p class="quiet">Moves while a button (or the space bar on it) is held down, at most at 250 mm/s, when the group stands by. This is no safety function: keep the emergency stop within reach.</p>
    </section>);
}
