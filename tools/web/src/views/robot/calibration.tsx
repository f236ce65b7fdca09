// SPDX-License-Identifier: Apache-2.0
// Calibration, step by step: tools by touching a fixed tip, frames by touching them, cameras by touching what they saw.

import { useEffect, useState } from "preact/hooks";
import { board_path, get, message_of, post } from "../../api/http";
import type { Calibration as Found } from "../../api/types";
import { DataTable, Fact } from "../../ui/parts";
import { request_reload } from "./service";
import type { RobotState } from "./state";

const KINDS: [string, string][] = [
  ["tool", "Tool"],
  ["frame", "Work frame"],
  ["camera", "Camera in the cell"],
  ["hand-camera", "Camera on the arm"],
];
// What a point of each kind touches, for the buttons.
const MARKS: Record<string, [string, string][]> = {
  tool: [["TIP", "Tip touches the fixed tip"], ["X", "Fixed tip on +x of the tool"], ["XZ", "Fixed tip in the plane of +x and +z"]],
  frame: [["ORIGIN", "Origin"], ["X", "On the x axis"], ["XY", "In the plane of x and y"]],
  camera: [["SEEN", "Touched what the camera saw"]],
  "hand-camera": [["SEEN", "The camera sees the mark"]],
};
const NAME = "[A-Za-z_][A-Za-z0-9_]*";

const mm = (value: number) => `${value.toFixed(3)} mm`;
const three = (values: number[]) => values.map((value) => value.toFixed(3)).join(", ");

// Reads "10, 20"; empty: there is a word that is no number.
function numbers_in(text: string): number[] {
  const numbers = text.split(/[\s,;]+/).filter(Boolean).map(Number);
  return numbers.every(Number.isFinite) ? numbers : [];
}

function Result({ now }: { now: Found }) {
  if (now.wrong) return now.points.length > 0 ? <p class="quiet">No result yet: {now.wrong}.</p> : null;
  return (
    <>
      <dl class="facts">
        <Fact name="Residual, rms" value={mm(now.rms)} />
        <Fact name="Largest residual" value={`${mm(now.most)}, point ${now.worst}`} />
        <Fact name="Standard deviation x, y, z" value={now.spare ? `${three(now.place_deviation)} mm` : "not known"} hint="estimated standard deviation of the result" />
        {now.turned && <Fact name="Standard deviation of angles" value={now.spare ? `${three(now.turn_deviation)} deg` : "not known"} hint="estimated standard deviations about the axes of the result" />}
      </dl>
      {now.spare === 0 && <p class="quiet">These are just enough points, so nothing shows how exact they are. Take more.</p>}
      {Math.abs(now.scale - 1) > 0.01 && <p class="warn">What was touched is {now.scale.toFixed(3)} times as large as what the camera saw: check its scale.</p>}
      {now.before && <p class="quiet">Now in the files: <code>{now.before}</code></p>}
      <p>Result: <code>{now.declaration}</code></p>
    </>);
}

interface PointsProps { now: Found; kind: string; camera: boolean; busy: boolean; drop: (point: number) => void }

function Points({ now, kind, camera, busy, drop }: PointsProps) {
  if (now.points.length === 0) return null;
  return (
    <DataTable label="Points of the calibration">
      <thead><tr><th scope="col">Point</th>{camera && <th scope="col">Seen, {kind === "camera" ? "mm" : "mm and deg"}</th>}<th scope="col" class="number">Residual</th><th scope="col" aria-label="Drop" /></tr></thead>
      <tbody>
        {now.points.map(({ mark, seen, off, place }, i) => (
          <tr key={`${i} ${place}`} title={place}>
            <th scope="row">{i + 1} {mark}</th>{camera && <td>{seen}</td>}
            <td class={`number ${now.worst === i + 1 && now.wrong ? "bad" : ""}`}>{off === null ? "-" : mm(off)}{now.worst === i + 1 && now.points.length > 1 ? ", largest" : ""}</td>
            <td><button type="button" disabled={busy} aria-label={`Drop point ${i + 1}`} onClick={() => drop(i + 1)}>Drop</button></td>
          </tr>))}
      </tbody>
    </DataTable>);
}

interface OpenProps { board: string; module: string; scope: string; kind: string; name: string; off: string; reload: () => void }

// One calibration. `off`: why no point can be taken.
function Open({ board, module, scope, kind, name, off, reload }: OpenProps) {
  const [now, set_now] = useState<Found | null>(null);
  const [seen, set_seen] = useState("");
  const [busy, set_busy] = useState(false);
  const [message, set_message] = useState("");
  const [problem, set_problem] = useState("");
  const [accepted, set_accepted] = useState(false);
  const path = board_path(board, `/robots/${encodeURIComponent(module)}/calibrations/${kind}/${name}`);
  const camera = kind.endsWith("camera");
  const run = async (request: Promise<Found>, success: (found: Found) => string): Promise<void> => {
    set_busy(true);
    set_problem("");
    try {
      const found = await request;
      set_now(found);
      set_message(success(found));
    } catch (error) {
      set_message("");
      set_problem(message_of(error));
    }
    set_busy(false);
  };
  useEffect(() => {
    let ended = false;
    get<Found>(path).then((found) => { if (!ended) set_now(found); }, (error) => { if (!ended) set_problem(message_of(error)); });
    return () => { ended = true; };
  }, [path]);
  const take = (mark: string) => {
    const numbers = numbers_in(seen);
    if (camera && numbers.length < 2) return set_problem("Enter where the camera saw it, as numbers.");
    set_accepted(false);
    void run(post<Found>(`${path}/take`, { robot: scope, mark, ...(camera ? { seen: numbers } : {}) }), (found) => `Point ${found.points.length} was taken.`);
  };
  const drop = (point: number) => void run(post<Found>(`${path}/drop`, { point }), () => (point ? `Point ${point} was dropped.` : "All points were dropped."));
  const accept = () => void run(post<Found>(`${path}/accept`, {}), (found) => {
    set_accepted(true);
    return `Declared: ${found.declaration}. The earlier declaration stays in the file as a comment. The robot uses the new one after a reload.`;
  });
  if (!now) return <p role="status" class="warn">{problem || "Loading..."}</p>;
  return (
    <>
      {now.next && !accepted && <p class="why" aria-live="polite">Next: {now.next}.</p>}
      {!now.next && !now.wrong && !accepted && <p class="why">There are enough points. Accept the result, or take more points for a better one.</p>}
      {off && <p class="quiet">{off}</p>}
      {camera && (
        <p><label>Seen at <input type="text" aria-label="Where the camera saw it" placeholder={kind === "camera" ? "x, y or x, y, z in mm" : "x, y, z, roll, pitch, yaw"} value={seen}
          onInput={(event) => set_seen(event.currentTarget.value)} /></label></p>)}
      <div class="bar">
        {MARKS[kind].map(([mark, title]) => (
          <button key={mark} type="button" class={mark === now.next_mark ? "main" : ""} disabled={busy || !!off} onClick={() => take(mark)}>Take: {title}</button>))}
      </div>
      <Points now={now} kind={kind} camera={camera} busy={busy} drop={drop} />
      {!accepted && <Result now={now} />}
      <div class="bar">
        {now.points.length > 0 && !accepted && <button type="button" class={now.wrong ? "" : "main"} disabled={busy || !!now.wrong} onClick={accept}>Accept the result</button>}
        {now.points.length > 0 && !accepted && <button type="button" disabled={busy} onClick={() => drop(0)}>Drop all points</button>}
        {accepted && <button type="button" class="main" onClick={reload}>Reload the robot's files</button>}
      </div>
      <p role="status" class={problem ? "bad" : "quiet"}>{problem || message}</p>
    </>);
}

// Why no point can be taken, as text; empty: points can be taken.
function why_not(state: RobotState | null, down: string): string {
  if (down) return `${down}: no points can be taken.`;
  if (!state) return "The status of the robot has not been received yet.";
  return ["moving", "homing", "stopping"].includes(state.group) ? `The robot is ${state.group}. Points are taken at standstill.` : "";
}

interface Props {
  board: string;
  module: string;
  scope: string;
  state: RobotState | null;
  down: string;  // why the robot task does not run; empty: it runs
  work_frames: string[];
}

export function Calibration({ board, module, scope, state, down, work_frames }: Props) {
  const [kind, set_kind] = useState("tool");
  const [name, set_name] = useState("");
  const [opened, set_opened] = useState("");
  const [message, set_message] = useState("");
  const reload = async (): Promise<void> => set_message(await request_reload(board, scope, state, "calibrated"));
  return (
    <section class="panel calibration" aria-label="Calibration">
      <details>
        <summary><h2>Calibration</h2></summary>
        <form class="bar" onSubmit={(event) => { event.preventDefault(); set_message(""); set_opened(name); }}>
          <label>Calibrate <select value={kind} onChange={(event) => { set_kind(event.currentTarget.value); set_opened(""); }}>
            {KINDS.map(([word, title]) => <option key={word} value={word}>{title}</option>)}</select></label>
          <label>Name <input type="text" required pattern={NAME} maxLength={64} list="calibrated" value={name} onInput={(event) => { set_name(event.currentTarget.value); set_opened(""); }} /></label>
          <datalist id="calibrated">{kind === "frame" && work_frames.map((frame) => <option key={frame} value={frame} />)}</datalist>
          <button type="submit" class={opened ? "" : "main"}>Begin</button>
        </form>
        {opened ? <Open key={`${kind} ${opened}`} board={board} module={module} scope={scope} kind={kind} name={opened} off={why_not(state, down)} reload={() => void reload()} />
          : <p class="quiet">Points are kept in a file next to the robot's files until the result is accepted.</p>}
        <p role="status" class="quiet">{message}</p>
      </details>
    </section>);
}
