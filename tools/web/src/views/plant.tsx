// SPDX-License-Identifier: Apache-2.0
// The boards of the network as their agents report them, including silent ones.

import { get } from "../api/http";
import type { RemoteBoard, PlantNow } from "../api/types";
import { plant as here } from "../shell/plant";
import { address } from "../ui/address";
import { count, span } from "../ui/format";
import { DataTable, Panel, Waiting } from "../ui/parts";
import { type Requested, useRequest, useStore } from "../ui/store";

const EVERY_MS = 1000;
export const SHOWN_ID = 12;  // letters of a deployment's id that are shown

// `releases`: how many different ones of InduRoP the boards run.
function Row({ row, releases }: { row: RemoteBoard; releases: number }) {
  const { boards } = useStore(here);
  const local = boards?.some(({ board }) => board === row.board);
  return (
    <tr>
      <th scope="row">{local ? <a href={address("variables", { board: row.board })}>{row.board}</a> : row.board}
        {row.message && <span class={`fault-text ${row.state === "running" && row.phase === "steady" ? "past" : ""}`}>{row.message}</span>}</th>
      <td class={row.heard ? (row.state === "running" ? "" : "warn") : "bad"}>{row.heard ? row.state : "silent"}
        {row.heard && row.phase !== "steady" ? `, ${row.phase}` : ""}</td>
      <td>{row.host}</td>
      <td>{row.plant || "-"}</td>
      <td title={row.deployment}>{row.deployment ? row.deployment.slice(0, SHOWN_ID) : "-"}</td>
      <td class={releases > 1 ? "warn" : ""}>{row.release || "-"}</td>
      <td class="number">{count(row.tick)}</td>
      <td class={`number ${row.lost_ticks ? "warn" : ""}`}>{count(row.lost_ticks)}</td>
      <td class={`number ${row.overruns ? "warn" : ""}`}>{count(row.overruns)}</td>
      <td class={`number ${row.faults ? "bad" : ""}`}>{count(row.faults)}</td>
      <td class="number">{span(row.age_ns)} ago</td>
    </tr>);
}

function state_of({ boards, trouble, problem }: PlantNow): [string, boolean] {
  if (problem) return ["not connected", false];
  if (boards.length === 0) return ["no boards", false];
  const silent = boards.filter(({ heard }) => !heard).length;
  if (silent > 0) return [`${silent} of ${boards.length} silent`, false];
  return trouble.length > 0 ? ["problems", false] : [`all ${boards.length} reporting`, true];
}

// Without `indurop serve --plant` no request is sent.
export function usePlant(): Requested<PlantNow> {
  const { status } = useStore(here);
  return useRequest(status?.plant ? "plant" : "", EVERY_MS, () => get<PlantNow>("plant"));
}

export function PlantPanel({ value, error }: { value: PlantNow | null; error: string }) {
  if (!value) return <Panel title="Plant">{error ? <p class="bad">{error}</p> : <Waiting />}</Panel>;
  const [state, good] = state_of(value);
  const releases = new Set(value.boards.map(({ release }) => release)).size;
  return (
    <Panel title="Plant" state={state} good={good}>
      {error && <p class="bad">{error}</p>}
      {value.problem && <p class="warn">{value.problem}</p>}
      {value.trouble.length > 0 && <ul class="problems">{value.trouble.map((text) => <li class="warning" key={text}>{text}</li>)}</ul>}
      {value.boards.length === 0 && <p class="quiet">No board reports on domain {value.domain}. Each board needs an agent: indurop-agent --board NAME.</p>}
      {value.boards.length > 0 && (
        <DataTable label="Boards of the plant">
            <thead><tr><th scope="col">Board</th><th scope="col">State</th><th scope="col">Host</th><th scope="col">Plant</th><th scope="col">Deployment</th>
              <th scope="col">Release</th>
              <th scope="col" class="number">Tick</th><th scope="col" class="number">Lost ticks</th><th scope="col" class="number">Overruns</th>
              <th scope="col" class="number">Faults</th><th scope="col" class="number">Last report</th></tr></thead>
            <tbody>{value.boards.map((row) => <Row key={row.board} row={row} releases={releases} />)}</tbody>
        </DataTable>)}
      <p><a href={address("deployments")}>Compare deployments, roll back</a></p>
    </Panel>);
}
