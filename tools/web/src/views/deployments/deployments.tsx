// SPDX-License-Identifier: Apache-2.0
// The deployments to the plant: a list, the differences between two of them, and the rollback.

import { useState } from "preact/hooks";
import { get, message_of, post } from "../../api/http";
import type { Deployment } from "../../api/types";
import { plant, useMay } from "../../shell/plant";
import { change_query, place } from "../../ui/address";
import { clock } from "../../ui/format";
import { DataTable, Name, Panel, Waiting } from "../../ui/parts";
import { useRequest, useStore } from "../../ui/store";
import { usePlant } from "../plant";
import { Difference, shown_id } from "./difference";

const EVERY_MS = 5000;
const ROLLING_MS = 120_000;

interface Choice {
  all: Deployment[];
  before: string;
  after: string;
  roll_back: (to: Deployment) => void;
}

function Rows({ all, before, after, roll_back }: Choice) {
  const may_roll_back = useMay("program");
  return (
    <DataTable label="Deployments" more="deployments">
        <thead><tr><th scope="col">Compare</th><th scope="col">With</th><th scope="col">Deployment</th><th scope="col">Roll back</th><th scope="col">Plant</th><th scope="col">Deployed</th>
          <th scope="col">Boards</th><th scope="col">Outcome</th></tr></thead>
        <tbody>{all.map((one) => {
          const name = `${shown_id(one.deployment)}, ${clock(one.wall_ns)}`;
          return (
            <tr key={`${one.generation} ${one.outcome}`} class={one.current ? "current" : ""}>
              <td><input type="radio" name="before" aria-label={`Compare from ${name}`} checked={before === one.deployment}
                onChange={() => change_query({ before: one.deployment })} /></td>
              <td><input type="radio" name="after" aria-label={`Compare to ${name}`} checked={after === one.deployment}
                onChange={() => change_query({ after: one.deployment })} /></td>
              <th scope="row" title={one.deployment}>{shown_id(one.deployment)}{one.current && <span class="chip good">running</span>}</th>
              <td>{may_roll_back && !one.current && one.outcome === "committed" &&
                <button type="button" aria-label={`Roll back to ${name}`} onClick={() => roll_back(one)}>Roll back</button>}</td>
              <td>{one.plant}</td><td>{clock(one.wall_ns)}<small>from {one.host}</small></td><td class="boards"><Name text={one.boards.join(", ")} /></td>
              <td class={one.outcome === "committed" ? "" : "warn"}>{one.outcome}</td>
            </tr>);
        })}</tbody>
    </DataTable>);
}

// The question before a rollback, which ends the running nodes.
function Confirm({ to, close, done }: { to: Deployment; close: () => void; done: () => void }) {
  const [reason, set_reason] = useState("");
  const [busy, set_busy] = useState(false);
  const [result, set_result] = useState<{ text: string; bad: boolean }>({ text: "", bad: false });
  const boards = usePlant().value?.boards.filter((one) => one.plant === to.plant) ?? [];
  const roll_back = async () => {
    set_busy(true);
    set_result({ text: "", bad: false });
    try {
      await post("plant/rollback", { deployment: to.deployment, plant: to.plant, ...(reason ? { reason } : {}) }, ROLLING_MS);
      set_result({ text: `${shown_id(to.deployment)} is running on all boards.`, bad: false });
    } catch (error) {
      set_result({ text: message_of(error), bad: true });
    }
    set_busy(false);
    done();
  };
  return (
    <section class="panel confirm" aria-label="Roll back">
      <h2>Roll plant {to.plant} back to {shown_id(to.deployment)}?</h2>
      <p>The nodes of all its boards end, and start again with the deployment of {clock(to.wall_ns)}. If a board is not healthy afterwards, all boards return to the current deployment.</p>
      <label class="reason">Reason, for the audit log <input value={reason} disabled={busy} onInput={(event) => set_reason(event.currentTarget.value)} /></label>
      <div class="bar">
        <button type="button" class="main" disabled={busy} onClick={() => void roll_back()}>Roll back now</button>
        <button type="button" disabled={busy} onClick={close}>Close</button>
      </div>
      {busy && <p role="status">{boards.map(({ board, phase }) => `${board}: ${phase}`).join(", ") || "In progress"}</p>}
      {result.text && <p role="status" class={result.bad ? "bad" : "good"}>{result.text}</p>}
    </section>);
}

// With `indurop serve --plant` the deployments that the boards recorded, otherwise those that run on this host.
export function Deployments() {
  const { status } = useStore(plant);
  const { query } = useStore(place);
  const [to, set_to] = useState<Deployment | null>(null);
  const path = status?.plant ? "plant/history" : "deployments";
  const { value, error, refresh } = useRequest(status ? path : "", EVERY_MS, () => get<{ deployments: Deployment[] }>(path));
  if (!value) return error ? <p class="bad">{error}</p> : <Waiting />;
  const all = value.deployments;
  const now = all.find(({ current }) => current);
  const before = query.get("before") ?? all.find((one) => one !== now && one.outcome === "committed")?.deployment ?? "";
  const after = query.get("after") ?? now?.deployment ?? "";
  return (
    <>
      {error && <p class="bad">{error}</p>}
      {to && <Confirm key={to.deployment} to={to} close={() => set_to(null)} done={refresh} />}
      <Panel title="Deployments">
        {all.length === 0 && <p class="quiet">This view lists what was deployed to the boards and when, compares two deployments, and rolls back. There are no deployments: the nodes of this host were started manually.</p>}
        {all.length > 0 && <Rows all={all} before={before} after={after} roll_back={set_to} />}
        {!status?.plant && <p class="quiet">To see the deployments that the agents of boards recorded, start the server with: indurop serve --plant</p>}
      </Panel>
      {status?.plant && before && after && before !== after && <Difference before={before} after={after} />}
    </>);
}
