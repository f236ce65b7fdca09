// SPDX-License-Identifier: Apache-2.0
// When each module ran, as measured; which runs were late, and why.

import { useMemo, useState } from "preact/hooks";
import { board_path, get } from "../../api/http";
import type { Module, Overrun, Runs, Schedule as Plan } from "../../api/types";
import { NoBoard } from "../../shell/no_board";
import { useBoard } from "../../shell/plant";
import { change_query, place } from "../../ui/address";
import { count, span } from "../../ui/format";
import { DataTable, Fact, Waiting } from "../../ui/parts";
import { useRequest, useStore } from "../../ui/store";
import { Gantt } from "./gantt";
import { Histograms } from "./histograms";
import { explain, lanes_of, overrun_text, type Bar } from "./lanes";

const PURPOSE = "This view shows when each module ran, and why it ran at that time.";
const EVERY_MS = 1000;
const PERIODS = [1, 2, 3, 5, 10, 20];
const ZOOMS = [1, 4, 16, 64];
const FIT_MARGIN = 1.1;
const MAX_RUNS = 1500;
const MAX_OVERRUNS = 50;

interface Details {
  plan: Plan;
  runs: Runs;
  modules: Module[];
  overruns: Overrun[];
}

async function fetch_details(board: string): Promise<Details> {
  const [plan, runs, { modules }, { overruns }] = await Promise.all([
    get<Plan>(board_path(board, "/schedule")),
    get<Runs>(board_path(board, `/runs?count=${MAX_RUNS}`)),
    get<{ modules: Module[] }>(board_path(board, "/modules")),
    get<{ overruns: Overrun[] }>(board_path(board, `/overruns?count=${MAX_OVERRUNS}`)),
  ]);
  return { plan, runs, modules, overruns };
}

function Times({ modules, chosen }: { modules: Module[]; chosen: string }) {
  return (
    <DataTable label="Times of the modules">
        <thead>
          <tr><th scope="col">Module</th><th scope="col" class="number">Core</th><th scope="col" class="number">Priority</th><th scope="col">Released</th>
            <th scope="col" class="number">Mean time</th><th scope="col" class="number">Maximum time</th><th scope="col" class="number">Jitter (50 %)</th>
            <th scope="col" class="number">Jitter (99 %)</th><th scope="col" class="number">Maximum jitter</th><th scope="col" class="number">Overruns</th></tr>
        </thead>
        <tbody>
          {modules.map((module) => (
            <tr key={module.name} class={module.name === chosen ? "chosen" : ""}>
              <th scope="row"><button type="button" class="link-button" aria-pressed={module.name === chosen}
                onClick={() => change_query({ m: module.name === chosen ? "" : module.name })}>{module.name}</button></th>
              <td class="number">{module.core !== undefined && module.core >= 0 ? module.core : "-"}</td><td class="number">{module.priority}</td>
              <td>{module.period_ns ? `every ${span(module.period_ns)}` : module.operation}</td>
              <td class="number">{module.runs ? span(module.mean_exec_ns) : "-"}</td><td class="number">{module.runs ? span(module.max_exec_ns) : "-"}</td>
              <td class="number">{module.period_ns ? span(module.jitter_p50_ns) : "-"}</td><td class="number">{module.period_ns ? span(module.jitter_p99_ns) : "-"}</td>
              <td class="number">{module.period_ns ? span(module.jitter_max_ns) : "-"}</td>
              <td class={`number ${module.overruns ? "bad" : ""}`}>{count(module.overruns)}</td>
            </tr>))}
        </tbody>
    </DataTable>);
}

function Overruns({ overruns, modules }: { overruns: Overrun[]; modules: Module[] }) {
  const period = (name: string) => modules.find((module) => module.name === name)?.period_ns ?? 0;
  if (overruns.length === 0) return <p class="good">No overruns were recorded.</p>;
  return (
    <ul class="problems">
      {[...overruns].reverse().slice(0, 10).map((overrun) => <li class="error" key={overrun.number}>{overrun_text(overrun, period(overrun.module))}</li>)}
    </ul>);
}

function Newest({ bars, choose }: { bars: Bar[]; choose: (bar: Bar) => void }) {
  return (
    <details class="panel">
      <summary>The newest runs as a table</summary>
      <DataTable label="The newest runs">
        <thead><tr><th scope="col" class="number">Tick</th><th scope="col">Module</th><th scope="col" class="number">Latency</th><th scope="col" class="number">Took</th><th scope="col">Late</th></tr></thead>
        <tbody>
          {bars.map((bar) => (
            <tr key={bar.run.number}>
              <td class="number">{bar.run.tick}</td>
              <th scope="row"><button type="button" class="link-button" onClick={() => choose(bar)}>{bar.run.module}</button></th>
              <td class="number">{span(bar.run.start_ns - bar.run.release_ns)}</td><td class="number">{span(bar.run.end_ns - bar.run.start_ns)}</td>
              <td class={bar.late ? "bad" : ""}>{bar.late ? "yes" : "no"}</td>
            </tr>))}
        </tbody>
      </DataTable>
    </details>);
}

export function Schedule() {
  const board = useBoard();
  const { query } = useStore(place);
  const periods = Number(query.get("n")) || 1;
  const zoom = Number(query.get("z"));  // 0: until the last run of a module
  const module = query.get("m") ?? "";
  const [held, set_held] = useState<Details | null>(null);
  const [bar, set_bar] = useState<Bar | null>(null);
  const { value, error } = useRequest(board?.board ?? "", EVERY_MS, () => fetch_details(board!.board));
  const now = held ?? value;
  const lanes = useMemo(() => (now ? lanes_of(now.runs.runs, now.modules, now.overruns) : []), [now]);
  if (!board) return <NoBoard purpose={PURPOSE} />;
  if (!now) return error ? <p class="bad">{error}</p> : <Waiting />;
  const { plan, runs, modules, overruns } = now;
  const epoch = runs.epoch_ns;
  const last_release = Math.max(epoch, ...runs.runs.map(({ release_ns }) => release_ns));
  // Whole macro periods that have ended, or the current one if there are none.
  const macro = plan.macro_period_ns || 1e9;
  const first_release = Math.min(last_release, ...runs.runs.map(({ release_ns }) => release_ns));
  const begun = epoch + Math.floor((last_release - epoch) / macro) * macro;
  const end = begun > first_release ? begun : begun + macro;
  const from = Math.max(epoch, end - periods * macro);
  const busy = Math.max(...runs.runs.filter(({ release_ns }) => release_ns >= from && release_ns < end).map(({ end_ns }) => end_ns - from));
  const to = zoom === 0 && busy > 0 ? Math.min(end, from + busy * FIT_MARGIN) : end;
  const newest = lanes.flatMap(({ bars }) => bars).sort((a, b) => b.run.number - a.run.number).slice(0, 20);
  const show = (chosen: Bar) => {
    set_bar(chosen);
    set_held(now);
  };
  return (
    <>
      <dl class="facts">
        <Fact name="Basic period" value={span(plan.basic_period_ns)} hint="greatest common divisor of all periods" />
        <Fact name="Macro period" value={span(plan.macro_period_ns)} hint="least common multiple of all periods" />
        <Fact name="Slots" value={count(plan.slots)} hint="basic periods in a macro period" />
        <Fact name="Runs" value={count(runs.runs.length)} />
      </dl>
      {plan.message && <p class="warn">{plan.message}</p>}
      {error && <p class="bad">{error}</p>}
      <section class="panel" aria-label="Newest macro periods">
        <div class="bar">
          <button type="button" aria-pressed={!!held} onClick={() => { set_held(held ? null : value); if (held) set_bar(null); }}>{held ? "Resume" : "Pause"}</button>
          <label class="choice">Show{" "}
            <select value={periods} onChange={(event) => change_query({ n: event.currentTarget.value })}>
              {PERIODS.map((n) => <option key={n} value={n}>{n} macro period{n === 1 ? "" : "s"}</option>)}
            </select></label>
          <label class="choice">Zoom{" "}
            <select value={zoom} onChange={(event) => change_query({ z: event.currentTarget.value === "0" ? "" : event.currentTarget.value })}>
              <option value={0}>fit</option>
              {ZOOMS.map((n) => <option key={n} value={n}>{n} x</option>)}
            </select></label>
          <span class="quiet">Click a bar to see why the module ran at that time. Red: late.</span>
        </div>
        {runs.runs.length === 0 ? <p>{PURPOSE} No run has been recorded yet.</p> :
          <Gantt lanes={lanes} from_ns={from} to_ns={to} epoch_ns={epoch} basic_ns={plan.basic_period_ns || macro} macro_ns={macro} zoom={zoom || 1}
            chosen={bar?.run.number ?? null} choose={show} />}
        {bar && (
          <div class="explained" role="status">
            <h3>{bar.run.module}</h3>
            <ul>{explain(bar, modules.find(({ name }) => name === bar.run.module), epoch).map((line) => <li key={line}>{line}</li>)}</ul>
          </div>)}
      </section>
      <section class="panel" aria-label="Overruns"><h2>Overruns</h2><Overruns overruns={overruns} modules={modules} /></section>
      <section class="panel" aria-label="Modules"><h2>Modules</h2><Times modules={modules} chosen={module} />
        {!module && <p class="quiet">Select a module to see the distribution of its times.</p>}</section>
      {module && board && <Histograms board={board.board} module={module} />}
      <Newest bars={newest} choose={show} />
    </>);
}
