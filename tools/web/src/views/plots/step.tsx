// SPDX-License-Identifier: Apache-2.0
// Steps through a recording: one tick back or forward, with the runs of that tick, and what modules kept after it.

import { useEffect, useRef, useState } from "preact/hooks";
import { post } from "../../api/http";
import type { RecordedTick, ReplayedTick } from "../../api/types";
import { useMay } from "../../shell/plant";
import { count, plural, span } from "../../ui/format";
import { DataTable, Name, useEntry, Waiting } from "../../ui/parts";
import { useRequest } from "../../ui/store";

const TIMEOUT_MS = 60_000;
const SETTLE_MS = 200;  // what modules kept is requested when the user has stopped stepping

interface DetailProps {
  path: string;  // of the recording in the API
  board: string;
  step: RecordedTick;
}

interface BarProps {
  step: RecordedTick | null;
  error: string;
  go: (tick: number) => void;
  close: () => void;
}

type Run = RecordedTick["runs"][number];
type Module = ReplayedTick["modules"][number];

function Values({ run, written }: { run: Run; written: boolean }) {
  const values = run.values.filter((one) => one.written === written);
  return values.length === 0 ? <>-</> : <>{values.map(({ name, text }) => <div key={name}><Name text={name} /> = {text}</div>)}</>;
}

function Runs({ runs }: { runs: Run[] }) {
  return (
    <DataTable label="Runs of this tick">
      <thead><tr><th scope="col">Module</th><th scope="col">Run</th><th scope="col">Began after</th><th scope="col">Took</th>
        <th scope="col">New to it</th><th scope="col">Wrote</th></tr></thead>
      <tbody>
        {runs.map((run) => (
          <tr key={`${run.module} ${run.number}`}>
            <th scope="row">{run.module}{run.faulted && <span class="bad"> (fault)</span>}</th>
            <td>{count(run.number)}</td><td>{span(run.start_ns - run.release_ns)}</td><td>{span(run.end_ns - run.start_ns)}</td>
            <td class="values"><Values run={run} written={false} /></td><td class="values"><Values run={run} written={true} /></td>
          </tr>))}
      </tbody>
    </DataTable>);
}

function Kept({ module, before }: { module: Module; before: Map<string, string> }) {
  const title = `${module.module} keeps`;
  if (module.state === "unknown") return <p class="quiet">{module.module}: not known, because {module.reason || "it did not run"}.</p>;
  return (
    <>
      {module.state === "doubtful" && <p class="warn">{module.module}: it may have kept something else, because {module.reason}.</p>}
      {module.kept.length === 0
        ? <p class="quiet">{module.module} {module.by_functions ? "keeps what its own functions copy; that is restored, but cannot be shown" : "keeps nothing"}.</p>
        : (
          <DataTable label={title}>
            <thead><tr><th scope="col">{title}</th><th scope="col">Value</th><th scope="col">Type</th></tr></thead>
            <tbody>
              {module.kept.map(({ name, type, value }) => {
                const was = before.get(`${module.module} ${name}`);
                return (
                  <tr key={name}><th scope="row"><Name text={name} /></th>
                    <td class={`values ${was !== undefined && was !== value ? "changed" : ""}`}>{value}</td><td class="quiet">{type.replace(/ #[0-9a-f]{16}$/, "")}</td></tr>);
              })}
            </tbody>
          </DataTable>)}
    </>);
}

function names_and_values({ modules }: ReplayedTick): Map<string, string> {
  return new Map(modules.flatMap(({ module, kept }) => kept.map(({ name, value }) => [`${module} ${name}`, value] as const)));
}

// What modules kept after the tick, from a replay on the server.
function KeptAfter({ path, board, tick }: { path: string; board: string; tick: number }) {
  const [settled, set_settled] = useState(tick);
  useEffect(() => {
    const timer = window.setTimeout(() => set_settled(tick), SETTLE_MS);
    return () => clearTimeout(timer);
  }, [tick]);
  const answer = useRequest(`replay ${path} ${board} ${settled}`, 0, () => post<ReplayedTick>(`${path}/replay`, { tick: settled, board }, TIMEOUT_MS));
  const shown = useRef<ReplayedTick | null>(null);
  const before = useRef(new Map<string, string>());
  if (answer.value && answer.value !== shown.current) {
    if (shown.current) before.current = names_and_values(shown.current);
    shown.current = answer.value;
  }
  if (answer.error) return <p class="bad" role="alert">What modules kept is not known: {answer.error}</p>;
  if (!shown.current) return <Waiting />;
  const { differing, modules, tick: of } = shown.current;
  return (
    <div class={of === tick ? "" : "old"}>
      <p class={differing === 0 ? "quiet" : "warn"} role="status">{differing === 0
        ? `What modules kept after tick ${of}, repeated from the keyframes before it. What they wrote in this tick is what was recorded, bit for bit.`
        : `The modules here wrote ${plural(differing, "other value")} in tick ${of} than recorded: they may have kept something else.`}</p>
      {modules.map((module) => <Kept key={module.module} module={module} before={before.current} />)}
    </div>);
}

// The buttons, above the charts.
export function StepBar({ step, error, go, close }: BarProps) {
  const to = (tick: number | null | undefined) => { if (tick !== null && tick !== undefined) go(tick); };
  const tick = useEntry(step?.tick ?? "", (text) => { if (text) go(Number(text)); });
  const handle_key = (event: KeyboardEvent) => {
    if ((event.target as HTMLElement).tagName === "INPUT" || !["ArrowLeft", "ArrowRight"].includes(event.key)) return;
    event.preventDefault();
    to(event.key === "ArrowLeft" ? step?.previous : step?.next);
  };
  return (
    <section class="panel step" aria-label="Steps through the recording" tabIndex={0} onKeyDown={handle_key}>
      <div class="bar">
        <button type="button" disabled={(step?.previous ?? null) === null} onClick={() => to(step?.previous)}>Step back</button>
        <button type="button" disabled={(step?.next ?? null) === null} onClick={() => to(step?.next)}>Step forward</button>
        <label class="choice">Tick{" "}
          <input class="ticks" type="number" min={0} {...tick} /></label>
        <button type="button" onClick={close}>Close</button>
        <span class="quiet">{step && `${plural(step.runs.length, "run")} in ${span(step.end_ns - step.begin_ns)}. A click in a chart goes there, arrow keys step.`}</span>
      </div>
      {error && <p class="bad" role="alert">{error}</p>}
      {!step && !error && <Waiting />}
    </section>);
}

// What happened in the tick, below the charts.
export function TickDetails({ path, board, step }: DetailProps) {
  const may_replay = useMay("program");
  return (
    <section class="panel step" aria-label="One tick of the recording">
      <h2>Tick {step.tick}</h2>
      <Runs runs={step.runs} />
      {may_replay
        ? <KeptAfter key={`${path} ${board}`} path={path} board={board} tick={step.tick} />
        : <p class="quiet">What modules keep inside is found by running them again, which needs the role program (indurop serve --write).</p>}
    </section>);
}
