// SPDX-License-Identifier: Apache-2.0
// Guiding by hand: a person moves the arm by its end, the server records the path, and a job is written of it.

import { useEffect, useRef, useState } from "preact/hooks";
import { board_path, get, message_of, post } from "../../api/http";
import type { GuidedPath, WrittenPath } from "../../api/types";
import { Fact } from "../../ui/parts";
import { Press } from "./press";
import { in_scope, request_reload } from "./service";
import type { RobotState } from "./state";

const POLL_MS = 500;
const EACH_S = 0.02;  // between two recorded places
const WRITING_MS = 60_000;
const NAME = "[A-Za-z][A-Za-z0-9_]*";

// Why the robot cannot be guided, as text with what to do; empty: it can.
function why_not(state: RobotState | null, down: string): string {
  if (down) return `${down}: the robot cannot be guided.`;
  if (!state) return "The status of the robot has not been received yet.";
  if (!state.manual) return "Only in manual mode: its key switch (ROBOT_MODE) selects the mode.";
  if (!state.may_move) return "Hold the enabling device of manual mode.";
  if (state.group === "disabled") return "The drives are disabled: enable them (Jogging).";
  if (state.group.includes("error")) return "An error stopped the group: remove its cause and reset it (Jogging).";
  return state.group === "standby" ? "" : `The group is ${state.group}. It can be guided in standby.`;
}

function Path({ path }: { path: GuidedPath }) {
  return (
    <dl class="facts">
      <Fact name="Recorded path" value={`${path.length.toFixed(0)} mm`} hint="way of the tip of the tool" />
      <Fact name="Time" value={`${(path.places * EACH_S).toFixed(0)} s`} />
      <Fact name="Marked points" value={String(path.marks)} hint="points that the job passes exactly, and at rest" />
      <Fact name="Tool" value={path.tool || "none"} />
    </dl>);
}

interface WriteProps { board: string; module: string; scope: string; state: RobotState | null }

// A job of the recorded path.
function Write({ board, module, scope, state }: WriteProps) {
  const [order, set_order] = useState({ job: "", within: "1", turned: "1", speed: "100" });
  const [busy, set_busy] = useState(false);
  const [written, set_written] = useState<WrittenPath | null>(null);
  const [message, set_message] = useState("");
  const write = async (): Promise<void> => {
    set_busy(true);
    set_message("");
    set_written(null);
    try {
      const { job, within, turned, speed } = order;
      set_written(await post<WrittenPath>(board_path(board, `/robots/${encodeURIComponent(module)}/guiding/write`),
        { robot: scope, job, within: Number(within), turned: Number(turned), speed: Number(speed) }, WRITING_MS));
    } catch (error) {
      set_message(message_of(error));
    }
    set_busy(false);
  };
  const number = (name: "within" | "turned" | "speed", title: string, unit: string, least: number, most: number) => (
    <label>{title} <input type="number" required min={least} max={most} step="any" value={order[name]}
      onInput={(event) => set_order({ ...order, [name]: event.currentTarget.value })} /> {unit}</label>);
  return (
    <>
      <form class="bar" onSubmit={(event) => { event.preventDefault(); void write(); }}>
        <label>Job <input type="text" required aria-label="Name of the job" pattern={NAME} maxLength={31} value={order.job} title="a letter, then letters, digits and _"
          onInput={(event) => set_order({ ...order, job: event.currentTarget.value })} /></label>
        {number("within", "Within", "mm", 0.05, 100)}
        {number("turned", "Turned by at most", "deg", 0.05, 45)}
        {number("speed", "Speed", "mm/s", 0.1, 10000)}
        <button type="submit" class={written ? "" : "main"} disabled={busy}>{busy ? "Writing ..." : "Write the job"}</button>
      </form>
      {written && (
        <>
          <p>Written: <code>{written.file}</code>, {written.length.toFixed(0)} mm in {written.points} points, within {written.deviation.toFixed(2)} mm and {written.turn_deviation.toFixed(2)} deg of the path.</p>
          {written.is_read
            ? <p><button type="button" class="main" onClick={() => void request_reload(board, scope, state, "guided").then(set_message)}>Reload the robot's files</button></p>
            : <p class="quiet">The robot does not read this file yet: name it in the property <code>jobs</code> of its module, then restart the node.</p>}
          <details><summary>The job</summary><pre class="scroll">{written.text}</pre></details>
        </>)}
      <p role="status" class="warn">{message}</p>
    </>);
}

interface Props {
  board: string;
  module: string;
  scope: string;
  state: RobotState | null;
  down: string;  // why the robot task does not run; empty: it runs
  may_write: boolean;
}

export function Guiding({ board, module, scope, state, down, may_write }: Props) {
  const [held, set_held] = useState(false);
  const [path, set_path] = useState<GuidedPath | null>(null);
  const [message, set_message] = useState("");
  const [before, set_before] = useState("");  // the message of the robot at the start
  const pressed = useRef<Press | null>(null);
  const last_mark = useRef(0);
  const stop = () => {
    pressed.current?.end();
    pressed.current = null;
    set_held(false);
  };
  // Unlike jogging, it goes on without the pointer: both hands are at the arm. It ends with the page, also if that is hidden.
  useEffect(() => {
    const stop_if_hidden = () => { if (document.hidden) stop(); };
    window.addEventListener("pagehide", stop);
    document.addEventListener("visibilitychange", stop_if_hidden);
    return () => {
      window.removeEventListener("pagehide", stop);
      document.removeEventListener("visibilitychange", stop_if_hidden);
      stop();
    };
  }, [board, scope]);
  // The robot has ended it: the switch has to be released before the next time.
  const ended = held && (!!down || (state !== null && (state.group.includes("error") || !state.manual || !state.may_move)));
  useEffect(() => { if (ended) stop(); }, [ended]);
  useEffect(() => {
    let left = false;
    const look = () => get<GuidedPath>(board_path(board, `/robots/${encodeURIComponent(module)}/guiding?robot=${encodeURIComponent(scope)}`))
      .then((found) => { if (!left) set_path(found); }, () => undefined);
    void look();
    const timer = held ? window.setInterval(() => void look(), POLL_MS) : 0;
    return () => {
      left = true;
      clearInterval(timer);
    };
  }, [board, module, scope, held]);
  const reason = why_not(state, down);
  const start = () => {
    set_message("");
    set_before(state?.job_message ?? "");
    pressed.current = new Press(board, (text) => { set_message(text); set_held(false); });
    set_held(true);
    void pressed.current.begin({ robot: scope, frame: "hand" });
  };
  const mark = async (): Promise<void> => {
    last_mark.current = Math.max(last_mark.current, state?.mark ?? 0) + 1;
    try {
      await post(board_path(board, "/set"), { values: { [in_scope(scope, "ROBOT_GUIDE.nMark")]: last_mark.current }, reason: "a point of a guided path" });
    } catch (error) {
      set_message(message_of(error));
    }
  };
  const refused = held && !state?.guided && state?.job_message !== before ? state?.job_message : "";
  return (
    <section class="panel guiding" aria-label="Guiding by hand">
      <details>
        <summary><h2>Guiding by hand</h2></summary>
        {reason && !held && <p class="why warn">{reason}</p>}
        {held && <p class={`why ${refused ? "warn" : ""}`} aria-live="polite">{refused || (state?.guided ? "Push the arm. It stands where you leave it." : "Release the arm until it can be guided.")}</p>}
        <div class="bar">
          {held ? <button type="button" class="stop" onClick={stop}>Stop guiding</button>
            : <button type="button" class="main" disabled={!!reason} onClick={start}>Start guiding</button>}
          <button type="button" disabled={!held || !state?.guided} onClick={() => void mark()}>Mark a point</button>
        </div>
        {path && path.places > 0 && <Path path={path} />}
        {path?.problem && <p class="warn">Recording has ended: {path.problem}.</p>}
        {path && path.places > 0 && !held && (may_write ? <Write board={board} module={module} scope={scope} state={state} />
          : <p class="quiet">A user with the role <code>tune</code> can write a job of this path.</p>)}
        <p role="status" class="warn">{message}</p>
        <p class="quiet">A hand moves the arm as long as this page is open and visible, and the enabling device of manual mode is held. Starting again records a new path. This is not a safety function: keep the emergency stop within reach.</p>
      </details>
    </section>);
}
