// SPDX-License-Identifier: Apache-2.0
// What was deployed to the plant, what differs between two of it, and the way back.

import { useState } from "preact/hooks";
import { get, post, words } from "../../api/http";
import type { Deployment } from "../../api/types";
import { plant } from "../../shell/plant";
import { change_query, place } from "../../ui/address";
import { clock } from "../../ui/format";
import { Figures, Panel, Waiting } from "../../ui/parts";
import { useAsked, useStore } from "../../ui/store";
import { usePlant } from "../plant";
import { Difference, shown_id } from "./difference";

const EVERY_MS = 5000;
const ROLLING_MS = 120_000;

interface Choice {
  all: Deployment[];
  before: string;
  after: string;
  back: (to: Deployment) => void;
}

function Rows({ all, before, after, back }: Choice) {
  const { status } = useStore(plant);
  return (
    <Figures label="Deployments" more="deployments">
        <thead><tr><th scope="col">Before</th><th scope="col">After</th><th scope="col">Deployment</th><th scope="col">Back to it</th><th scope="col">Plant</th><th scope="col">When</th>
          <th scope="col">From</th><th scope="col">Boards</th><th scope="col">Outcome</th></tr></thead>
        <tbody>{all.map((one) => {
          const name = `${shown_id(one.deployment)}, ${clock(one.wall_ns)}`;
          return (
            <tr key={`${one.generation} ${one.outcome}`} class={one.current ? "current" : ""}>
              <td><input type="radio" name="before" aria-label={`Compare from ${name}`} checked={before === one.deployment}
                onChange={() => change_query({ before: one.deployment })} /></td>
              <td><input type="radio" name="after" aria-label={`Compare to ${name}`} checked={after === one.deployment}
                onChange={() => change_query({ after: one.deployment })} /></td>
              <th scope="row" title={one.deployment}>{shown_id(one.deployment)}{one.current && <span class="chip good">runs now</span>}</th>
              <td>{status?.may_write && !one.current && one.outcome === "committed" &&
                <button type="button" aria-label={`Roll back to ${name}`} onClick={() => back(one)}>Roll back</button>}</td>
              <td>{one.plant}</td><td>{clock(one.wall_ns)}</td><td>{one.host}</td><td class="boards">{one.boards.join(", ")}</td>
              <td class={one.outcome === "committed" ? "" : "warn"}>{one.outcome}</td>
            </tr>);
        })}</tbody>
    </Figures>);
}

// Asked once more, for it ends what runs.
function Confirm({ to, give_up, done }: { to: Deployment; give_up: () => void; done: () => void }) {
  const [reason, because] = useState("");
  const [busy, set_busy] = useState(false);
  const [said, say] = useState<{ text: string; bad: boolean }>({ text: "", bad: false });
  const boards = usePlant().value?.boards.filter((one) => one.plant === to.plant) ?? [];
  const go = async () => {
    set_busy(true);
    say({ text: "", bad: false });
    try {
      await post("plant/rollback", { deployment: to.deployment, plant: to.plant, ...(reason ? { reason } : {}) }, ROLLING_MS);
      say({ text: `${shown_id(to.deployment)} runs again on all boards.`, bad: false });
    } catch (error) {
      say({ text: words(error), bad: true });
    }
    set_busy(false);
    done();
  };
  return (
    <section class="panel confirm" aria-label="Roll back">
      <h2>Roll plant {to.plant} back to {shown_id(to.deployment)}?</h2>
      <p>The nodes of all its boards end and start again with what they ran on {clock(to.wall_ns)}. If a board is not healthy then, all go back to what they run now.</p>
      <label class="reason">Reason, for the audit log <input value={reason} disabled={busy} onInput={(event) => because(event.currentTarget.value)} /></label>
      <div class="bar">
        <button type="button" class="main" disabled={busy} onClick={() => void go()}>Roll back now</button>
        <button type="button" disabled={busy} onClick={give_up}>Close</button>
      </div>
      {busy && <p role="status">{boards.map(({ board, phase }) => `${board}: ${phase}`).join(", ") || "Under way"}</p>}
      {said.text && <p role="status" class={said.bad ? "bad" : "good"}>{said.text}</p>}
    </section>);
}

// Of a plant what its boards remember, else what the nodes of this host run.
export function Deployments() {
  const { status } = useStore(plant);
  const { query } = useStore(place);
  const [to, choose] = useState<Deployment | null>(null);
  const path = status?.plant ? "plant/history" : "deployments";
  const { value, error, again } = useAsked(status ? path : "", EVERY_MS, () => get<{ deployments: Deployment[] }>(path), words);
  if (!value) return error ? <p class="bad">{error}</p> : <Waiting />;
  const all = value.deployments;
  const now = all.find(({ current }) => current);
  const before = query.get("before") ?? all.find((one) => one !== now && one.outcome === "committed")?.deployment ?? "";
  const after = query.get("after") ?? now?.deployment ?? "";
  return (
    <>
      {error && <p class="bad">{error}</p>}
      {to && <Confirm key={to.deployment} to={to} give_up={() => choose(null)} done={again} />}
      <Panel title="Deployments">
        {all.length === 0 && <p class="quiet">Here stands what was put to work on the boards and when, what differs between two of it, and the way back. Nothing was deployed: nodes here were started by hand.</p>}
        {all.length > 0 && <Rows all={all} before={before} after={after} back={choose} />}
        {!status?.plant && <p class="quiet">What was deployed before is known to the agents of boards: indurop serve --plant</p>}
      </Panel>
      {status?.plant && before && after && before !== after && <Difference before={before} after={after} />}
    </>);
}
