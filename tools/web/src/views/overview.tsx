// SPDX-License-Identifier: Apache-2.0
// All boards at a glance: first what is wrong, in words, then how each board and its modules do.

import { useState } from "preact/hooks";
import { board_path, get, post, words } from "../api/http";
import type { Board, BoardSummary, Fault, Module } from "../api/types";
import { plant } from "../shell/plant";
import { address, place } from "../ui/address";
import { count, percent, plural, span } from "../ui/format";
import { useAsked, useStore } from "../ui/store";
import { Figure, Figures, Panel, Waiting } from "../ui/parts";
import { PlantPanel, SHOWN_ID, usePlant } from "./plant";
import { StopQuestion } from "./stopping";

const EVERY_MS = 2000;

interface Look {
  board: Board;
  modules: Module[];
  faults: Fault[];
}

async function look(board: string): Promise<Look> {
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

function Orders({ board, module, done }: { board: string; module: Module; done: () => void }) {
  const [said, say] = useState("");
  const order = async (what: string) => {
    try {
      await post(board_path(board, `/modules/${encodeURIComponent(module.name)}/${what}`));
      say("");
    } catch (error) {
      say(words(error));
    }
    done();
  };
  const [asked, ask] = useState("");
  const stopped = !["running", "starting"].includes(module.state);
  return (
    <span class="orders">
      <button type="button" onClick={() => (stopped ? order("start") : ask("stop"))} aria-label={`${stopped ? "Start" : "Stop"} ${module.name}`}>
        {stopped ? "start" : "stop"}</button>
      <button type="button" onClick={() => (stopped ? order("restart") : ask("restart"))} aria-label={`Restart ${module.name}`}>restart</button>
      {asked && <StopQuestion board={board} module={module.name} what={asked} close={() => ask("")} agree={() => { ask(""); void order(asked); }} />}
      {said && <span class="bad" role="alert">{said}</span>}
    </span>);
}

const STATE_LOOKS: Record<string, string> = { running: "", exited: "", stopped: "bad", faulted: "bad" };

function Modules({ board, modules, may_write, done }: { board: string; modules: Module[]; may_write: boolean; done: () => void }) {
  return (
    <Figures label={`Modules of ${board}`}>
        <thead>
          <tr><th scope="col">Module</th><th scope="col">State</th><th scope="col">Released</th><th scope="col" class="number">Runs</th>
            <th scope="col" class="number">Skipped</th><th scope="col" class="number">Overruns</th><th scope="col" class="number">Takes (mean)</th>
            <th scope="col" class="number">At most</th><th scope="col" class="number">Jitter (99 %)</th>{may_write && <th scope="col">Orders</th>}</tr>
        </thead>
        <tbody>
          {modules.map((module) => (
            <tr key={module.name}>
              <th scope="row">{module.name}{module.last_fault && <span class="fault-text">{module.last_fault}</span>}</th>
              <td class={STATE_LOOKS[module.state] ?? "warn"}>{module.state}</td>
              <td>{module.period_ns ? `every ${span(module.period_ns)}` : module.operation}</td>
              <td class="number">{count(module.runs)}</td>
              <td class={`number ${module.skipped ? "warn" : ""}`}>{count(module.skipped)}</td>
              <td class={`number ${module.overruns ? "bad" : ""}`}>{count(module.overruns)}</td>
              <td class="number">{module.runs ? span(module.mean_exec_ns) : "-"}</td>
              <td class="number">{module.runs ? span(module.max_exec_ns) : "-"}</td>
              <td class="number">{module.period_ns && module.runs ? span(module.jitter_p99_ns) : "-"}</td>
              {may_write && <td><Orders board={board} module={module} done={done} /></td>}
            </tr>))}
        </tbody>
    </Figures>);
}

const MOST_LINES = 8;

// `faults` say the same as `trouble` of the summary, which is there first.
function Troubles({ summary, faults }: { summary: BoardSummary; faults: Fault[] | null }) {
  const lines: Fault[] = faults ?? summary.trouble.map((text) => ({ severity: "warning", module: "", text }));
  const line = ({ severity, text, module }: Fault) => (
    <li class={severity} key={module + text}><strong>{severity}</strong> {module && !text.includes(module) ? `${module}: ` : ""}{text}</li>);
  if (lines.length === 0) return null;
  return (
    <>
      <ul class="troubles">{lines.slice(0, MOST_LINES).map(line)}</ul>
      {lines.length > MOST_LINES && (
        <details><summary>{`${lines.length - MOST_LINES} more`}</summary><ul class="troubles">{lines.slice(MOST_LINES).map(line)}</ul></details>)}
    </>);
}

function BoardCard({ summary }: { summary: BoardSummary }) {
  const { status } = useStore(plant);
  const { value, error, again } = useAsked(summary.board, EVERY_MS, () => look(summary.board), words);
  const board = value?.board;
  const lost = board && number_of(board, "lost_ticks");
  const ticks = board && number_of(board, "ticks");
  const uptime = board && number_of(board, "uptime_ns");
  const not_exact = (board?.rt as { why?: string } | undefined)?.why;
  return (
    <Panel title={summary.board} state={summary.alive ? summary.state : `gone (${summary.state})`} good={summary.alive && summary.state === "running"}>
      <Troubles summary={summary} faults={value?.faults ?? null} />
      {error && <p class="bad">{error}</p>}
      {!value && !error && <Waiting />}
      {board && value && <>
        <dl class="facts">
          <Figure name="Up for" value={uptime ? span(uptime) : "-"} />
          <Figure name="Load" value={load_text(value.modules)} hint="time in modules, by their mean execution times" />
          <Figure name="Ticks" value={ticks === null || ticks === undefined ? "-" : count(ticks)} />
          <Figure name="Lost ticks" value={lost === null || lost === undefined ? "-" : count(lost)} bad={!!lost} />
          <Figure name="Overruns" value={count(summary.overruns)} bad={summary.overruns > 0} />
          <Figure name="Faults" value={count(summary.faults)} bad={summary.faults > 0} />
          <Figure name="Forced" value={count(summary.forces)} warn={summary.forces > 0} />
          <Figure name="Deployment" value={summary.deployment ? summary.deployment.slice(0, SHOWN_ID) : "started by hand"} hint={summary.deployment || undefined} />
        </dl>
        {not_exact && <p class="warn">Not real time: {not_exact}</p>}
        <Modules board={summary.board} modules={value.modules} may_write={!!status?.may_write} done={again} />
        <p class="links">
          <a href={address("variables", { board: summary.board })}>Variables</a>{" "}
          <a href={address("schedule", { board: summary.board })}>Schedule</a>
        </p>
      </>}
    </Panel>);
}

// Of another host: asked only while somebody wants to see it.
function RemoteCard({ summary }: { summary: BoardSummary }) {
  const [open, toggle] = useState(false);
  return (
    <details class="panel" onToggle={(event) => toggle(event.currentTarget.open)}>
      <summary>{summary.board}: its modules{summary.host ? `, on ${summary.host}` : ""}</summary>
      {open && <BoardCard summary={summary} />}
    </details>);
}

function first_of(trouble: string[]): string {
  return `${trouble[0] ?? "something is wrong"}${trouble.length > 1 ? `, and ${trouble.length - 1} more` : ""}.`;
}

// Boards that were running while this page was open. Of those that ended before it says nothing by itself.
const seen = new Set<string>();
plant.listen(() => plant.get().boards?.forEach(({ board, alive }) => alive && seen.add(board)));

// One sentence for the whole plant.
function Headline({ running, gone, remote }: { running: BoardSummary[]; gone: BoardSummary[]; remote: string[] }) {
  const wrong = running.filter(({ trouble, faults, overruns }) => trouble.length > 0 || faults > 0 || overruns > 0);
  const forced = running.reduce((sum, { forces }) => sum + forces, 0);
  const parts = remote.map((text) => `${text[0].toUpperCase()}${text.slice(1)}.`);
  if (wrong.length > 0) parts.push(...wrong.map(({ board, trouble }) => `${board}: ${first_of(trouble)}`));
  else if (running.length > 0) parts.push(running.length === 1 ? "The board runs, nothing is wrong." : `All ${running.length} boards that run are well.`);
  else if (remote.length === 0) parts.push("No board runs.");
  if (gone.length > 0 && running.length > 0) parts.push(`${gone.map(({ board }) => board).join(", ")} ${gone.length === 1 ? "does" : "do"} not run any more.`);
  if (forced > 0) parts.push(`${plural(forced, "value is", "values are")} forced.`);
  return <p class={`headline ${remote.length + wrong.length + gone.length > 0 || running.length === 0 ? "is-bad" : forced > 0 ? "is-warn" : "is-good"}`}>{parts.join(" ")}</p>;
}

export function Overview() {
  const { boards: all, status } = useStore(plant);
  const chosen = useStore(place).query.get("board");
  const live = usePlant();
  if (!all) return <Waiting />;
  const boards = all.filter(({ here }) => here);  // the others are the plant's
  // Boards of this host say themselves what is wrong with them.
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
          <summary>{plural(ended.length, "board")} that ended and left {ended.length === 1 ? "its" : "their"} last values</summary>
          <ul class="plain">{ended.map(({ board, state, trouble }) => (
            <li key={board}><a href={address("overview", { board })}>{board}</a>: {trouble[0] ?? state}</li>))}</ul>
          <p class="quiet">They are looked at by choosing them above. <code>indurop clean</code> removes what they left.</p>
        </details>)}
    </>);
}
