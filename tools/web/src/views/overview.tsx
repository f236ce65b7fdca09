// SPDX-License-Identifier: Apache-2.0
// All boards at a glance: first a sentence about problems, then the values of each board and its modules.

import { useState } from "preact/hooks";
import { board_path, get, message_of, post } from "../api/http";
import type { Board, BoardSummary, Fault, Module } from "../api/types";
import { NoBoard } from "../shell/no_board";
import { plant, useMay } from "../shell/plant";
import { address, place } from "../ui/address";
import { count, percent, plural, span } from "../ui/format";
import { useRequest, useStore } from "../ui/store";
import { Fact, DataTable, Panel, Waiting } from "../ui/parts";
import { PlantPanel, SHOWN_ID, usePlant } from "./plant";
import { StopQuestion } from "./stopping";

const PURPOSE = "This view shows the problems, values and modules of all boards.";
const EVERY_MS = 2000;

interface Details {
  board: Board;
  modules: Module[];
  faults: Fault[];
}

async function fetch_details(board: string): Promise<Details> {
  const [state, { modules }, { faults }] = await Promise.all([
    get<Board>(board_path(board)),
    get<{ modules: Module[] }>(board_path(board, "/modules")),
    get<{ faults: Fault[] }>(board_path(board, "/faults")),
  ]);
  return { board: state, modules, faults };
}

// Share of its time each core spends in modules, by their mean execution times.
export function core_loads(modules: Module[]): [number, number][] {
  const loads = new Map<number, number>();
  for (const { core, period_ns, mean_exec_ns } of modules) {
    if (period_ns > 0 && mean_exec_ns) loads.set(core ?? 0, (loads.get(core ?? 0) ?? 0) + mean_exec_ns / period_ns);
  }
  return [...loads].sort(([a], [b]) => a - b);
}

function load_text(modules: Module[]): string {
  const loads = core_loads(modules);
  if (loads.length === 0) return "-";
  if (loads.length === 1) return percent(loads[0][1]);
  return loads.map(([core, load]) => `core ${core}: ${percent(load)}`).join(", ");
}

function number_of(board: Board, name: string): number | null {
  const value = board[name];
  return typeof value === "number" ? value : null;
}

function Actions({ board, module, done }: { board: string; module: Module; done: () => void }) {
  const [error, set_error] = useState("");
  const command = async (act: string) => {
    try {
      await post(board_path(board, `/modules/${encodeURIComponent(module.name)}/${act}`));
      set_error("");
    } catch (problem) {
      set_error(message_of(problem));
    }
    done();
  };
  const [question, set_question] = useState("");
  const stopped = !["running", "starting"].includes(module.state);
  return (
    <span class="actions">
      <button type="button" onClick={() => (stopped ? command("start") : set_question("stop"))} aria-label={`${stopped ? "Start" : "Stop"} ${module.name}`}>
        {stopped ? "start" : "stop"}</button>
      <button type="button" onClick={() => (stopped ? command("restart") : set_question("restart"))} aria-label={`Restart ${module.name}`}>restart</button>
      {question && <StopQuestion board={board} module={module.name} act={question} close={() => set_question("")} agree={() => { set_question(""); void command(question); }} />}
      {error && <span class="bad" role="alert">{error}</span>}
    </span>);
}

const CLASS_OF_STATE: Record<string, string> = { running: "", exited: "", stopped: "bad", faulted: "bad" };

function Modules({ board, modules, may_write, done }: { board: string; modules: Module[]; may_write: boolean; done: () => void }) {
  return (
    <DataTable label={`Modules of ${board}`}>
        <thead>
          <tr><th scope="col">Module</th><th scope="col">State</th><th scope="col">Released</th><th scope="col" class="number">Runs</th>
            <th scope="col" class="number">Skipped</th><th scope="col" class="number">Overruns</th><th scope="col" class="number">Mean time</th>
            <th scope="col" class="number">Maximum time</th><th scope="col" class="number">Jitter (99 %)</th>{may_write && <th scope="col">Actions</th>}</tr>
        </thead>
        <tbody>
          {modules.map((module) => (
            <tr key={module.name}>
              <th scope="row">{module.name}{module.last_fault && <span class="fault-text">{module.last_fault}</span>}</th>
              <td class={CLASS_OF_STATE[module.state] ?? "warn"}>{module.state}</td>
              <td>{module.period_ns ? `every ${span(module.period_ns)}` : module.operation}</td>
              <td class="number">{count(module.runs)}</td>
              <td class={`number ${module.skipped ? "warn" : ""}`}>{count(module.skipped)}</td>
              <td class={`number ${module.overruns ? "bad" : ""}`}>{count(module.overruns)}</td>
              <td class="number">{module.runs ? span(module.mean_exec_ns) : "-"}</td>
              <td class="number">{module.runs ? span(module.max_exec_ns) : "-"}</td>
              <td class="number">{module.period_ns && module.runs ? span(module.jitter_p99_ns) : "-"}</td>
              {may_write && <td><Actions board={board} module={module} done={done} /></td>}
            </tr>))}
        </tbody>
    </DataTable>);
}

const MAX_LINES = 8;

// `faults` are the same problems as `trouble` of the summary, in more detail; they arrive later.
function Problems({ summary, faults }: { summary: BoardSummary; faults: Fault[] | null }) {
  const lines: Fault[] = faults ?? summary.trouble.map((text) => ({ severity: "warning", module: "", text }));
  const line = ({ severity, text, module }: Fault) => (
    <li class={severity} key={module + text}><strong>{severity}</strong> {module && !text.includes(module) ? `${module}: ` : ""}{text}</li>);
  if (lines.length === 0) return null;
  return (
    <>
      <ul class="problems">{lines.slice(0, MAX_LINES).map(line)}</ul>
      {lines.length > MAX_LINES && (
        <details><summary>{`${lines.length - MAX_LINES} more`}</summary><ul class="problems">{lines.slice(MAX_LINES).map(line)}</ul></details>)}
    </>);
}

function BoardCard({ summary }: { summary: BoardSummary }) {
  const may_command = useMay("program");
  const { value, error, refresh } = useRequest(summary.board, EVERY_MS, () => fetch_details(summary.board));
  const board = value?.board;
  const lost = board && number_of(board, "lost_ticks");
  const ticks = board && number_of(board, "ticks");
  const uptime = board && number_of(board, "uptime_ns");
  return (
    <Panel title={summary.board} state={summary.alive ? summary.state : `not running (last: ${summary.state})`} good={summary.alive && summary.state === "running"}>
      <Problems summary={summary} faults={value?.faults ?? null} />
      {error && <p class="bad">{error}</p>}
      {!value && !error && <Waiting />}
      {board && value && <>
        <dl class="facts">
          <Fact name="Uptime" value={uptime ? span(uptime) : "-"} />
          <Fact name="Load" value={load_text(value.modules)} hint="share of time spent in modules, from their mean execution times" />
          <Fact name="Ticks" value={ticks === null || ticks === undefined ? "-" : count(ticks)} />
          <Fact name="Lost ticks" value={lost === null || lost === undefined ? "-" : count(lost)} bad={!!lost} />
          <Fact name="Overruns" value={count(summary.overruns)} bad={summary.overruns > 0} />
          <Fact name="Faults" value={count(summary.faults)} bad={summary.faults > 0} />
          <Fact name="Forced" value={count(summary.forces)} warn={summary.forces > 0} />
          <Fact name="Deployment" value={summary.deployment ? summary.deployment.slice(0, SHOWN_ID) : "started manually"} hint={summary.deployment || undefined} />
        </dl>
        <Modules board={summary.board} modules={value.modules} may_write={may_command} done={refresh} />
        <p class="links">
          <a href={address("variables", { board: summary.board })}>Variables</a>{" "}
          <a href={address("schedule", { board: summary.board })}>Schedule</a>
        </p>
      </>}
    </Panel>);
}

// A board of another host: requested only while its section is open.
function RemoteCard({ summary }: { summary: BoardSummary }) {
  const [open, set_open] = useState(false);
  return (
    <details class="panel" onToggle={(event) => set_open(event.currentTarget.open)}>
      <summary>Modules of {summary.board}{summary.host ? `, on ${summary.host}` : ""}</summary>
      {open && <BoardCard summary={summary} />}
    </details>);
}

function first_of(trouble: string[]): string {
  return `${trouble[0] ?? "unknown problem"}${trouble.length > 1 ? `, and ${trouble.length - 1} more` : ""}.`;
}

// Boards that were running while this page was open; boards that ended earlier are not reported as a problem.
const seen = new Set<string>();
plant.listen(() => plant.get().boards?.forEach(({ board, alive }) => alive && seen.add(board)));

// One sentence for the whole plant.
function Headline({ running, gone, remote }: { running: BoardSummary[]; gone: BoardSummary[]; remote: string[] }) {
  const wrong = running.filter(({ trouble, faults, overruns }) => trouble.length > 0 || faults > 0 || overruns > 0);
  const forced = running.reduce((sum, { forces }) => sum + forces, 0);
  const parts = remote.map((text) => `${text[0].toUpperCase()}${text.slice(1)}.`);
  if (wrong.length > 0) parts.push(...wrong.map(({ board, trouble }) => `${board}: ${first_of(trouble)}`));
  else if (running.length > 0) parts.push(running.length === 1 ? "The board is running without problems." : `All ${running.length} running boards are without problems.`);
  else if (remote.length === 0) parts.push("No board is running.");
  if (gone.length > 0 && running.length > 0) parts.push(`${gone.map(({ board }) => board).join(", ")} ${gone.length === 1 ? "is" : "are"} no longer running.`);
  if (forced > 0) parts.push(`${plural(forced, "value is", "values are")} forced.`);
  return <p class={`headline ${remote.length + wrong.length + gone.length > 0 || running.length === 0 ? "is-bad" : forced > 0 ? "is-warn" : "is-good"}`}>{parts.join(" ")}</p>;
}

export function Overview() {
  const { boards: all, status } = useStore(plant);
  const chosen = useStore(place).query.get("board");
  const live = usePlant();
  if (!all || (all.length === 0 && !status?.plant)) return <NoBoard purpose={PURPOSE} />;
  const boards = all.filter(({ here }) => here);  // the plant lists the others
  // Boards of this host report their problems themselves.
  const silent = live.value?.trouble.filter((text) => !boards.some(({ board, alive }) => alive && text.startsWith(`board ${board}:`))) ?? [];
  const elsewhere = [...silent, ...all.filter(({ here, alive, trouble }) => !here && alive && trouble.length > 0).map(({ board, trouble }) => `${board}: ${trouble[0]}`)];
  const rank = ({ faults, trouble }: BoardSummary) => (faults > 0 ? 0 : trouble.length > 0 ? 1 : 2);
  const sorted = [...boards].sort((a, b) => rank(a) - rank(b) || a.board.localeCompare(b.board));
  const running = sorted.filter(({ alive }) => alive);
  const gone = sorted.filter(({ alive, board }) => !alive && seen.has(board));
  const shown = [...running, ...sorted.filter((one) => !one.alive && (gone.includes(one) || one.board === chosen))];
  const ended = sorted.filter((one) => !shown.includes(one));
  return (
    <>
      {(boards.length > 0 || elsewhere.length > 0) && <Headline running={running} gone={gone} remote={elsewhere} />}
      {status?.plant && <PlantPanel value={live.value} error={live.error} />}
      <div class="cards">{shown.map((summary) => <BoardCard key={summary.board} summary={summary} />)}</div>
      {all.filter(({ here, alive }) => !here && alive).map((summary) => <RemoteCard key={summary.board} summary={summary} />)}
      {ended.length > 0 && (
        <details class="panel">
          <summary>{plural(ended.length, "board")} that {ended.length === 1 ? "has" : "have"} ended</summary>
          <ul class="plain">{ended.map(({ board, state, trouble }) => (
            <li key={board}><a href={address("overview", { board })}>{board}</a>: {trouble[0] ?? state}</li>))}</ul>
          <p class="quiet">Select one in the header to see its last values. <code>indurop clean</code> removes its files.</p>
        </details>)}
    </>);
}
