// SPDX-License-Identifier: Apache-2.0
// The audit log of the server, newest entries first, and above it the users, for those who administer them.

import { useState } from "preact/hooks";
import { get } from "../../api/http";
import type { AuditEntry } from "../../api/types";
import { plant, useMay } from "../../shell/plant";
import { clock, plural } from "../../ui/format";
import { DataTable, Name, Panel, Waiting } from "../../ui/parts";
import { useRequest, useStore } from "../../ui/store";
import { Users } from "./users";

const EVERY_MS = 5000;
const COUNTS = [100, 1000];

function is_good(outcome: string): boolean {
  return outcome === "done" || outcome === "begun";
}

function Entries({ all }: { all: AuditEntry[] }) {
  return (
    <DataTable label="Audit log" more="audit">
      <thead><tr><th scope="col">When</th><th scope="col">Who</th><th scope="col">Board</th><th scope="col">Action</th><th scope="col">What</th>
        <th scope="col">Outcome</th><th scope="col">Reason</th></tr></thead>
      <tbody>{all.map((one, i) => (
        <tr key={`${one.wall_ns} ${i}`}>
          <td>{clock(one.wall_ns)}</td><th scope="row">{one.who || "unknown user"}{one.from && <small>from {one.from}</small>}</th>
          <td>{one.board}</td><td>{one.action}</td><td class="what"><Name text={one.what} /></td>
          <td class={`what ${is_good(one.outcome) ? "" : "warn"}`}>{one.outcome}</td><td class="what">{one.reason}</td>
        </tr>))}
      </tbody>
    </DataTable>);
}

export function Audit() {
  const { status } = useStore(plant);
  const may_administer = useMay("administer");
  const [count, set_count] = useState(COUNTS[0]);
  const [text, set_text] = useState("");
  const { value, error } = useRequest(`audit ${count}`, EVERY_MS, () => get<{ audit: AuditEntry[] }>(`audit?count=${count}`));
  const wanted = text.trim().toLowerCase();
  const all = value ? [...value.audit].reverse() : [];
  const shown = all.filter((one) => [one.who, one.from, one.board, one.action, one.what, one.outcome, one.reason]
    .some((part) => part.toLowerCase().includes(wanted)));
  return (
    <>
      {status?.users && may_administer && <Users />}
      <Panel title="Audit log">
        {error && <p class="bad">{error}</p>}
        {!value && !error && <Waiting />}
        {value && all.length === 0 && <p class="quiet">This view lists who changed what through this server and from where, and what was refused. There are no entries.</p>}
        {all.length > 0 && (
          <>
            <div class="bar">
              <label>Filter <input type="search" value={text} onInput={(event) => set_text(event.currentTarget.value)} /></label>
              <label>Newest <select value={count} onChange={(event) => set_count(Number(event.currentTarget.value))}>
                {COUNTS.map((one) => <option key={one} value={one}>{one}</option>)}
              </select></label>
              <span class="quiet" role="status">{wanted ? `${plural(shown.length, "entry", "entries")} of ${all.length}` : plural(all.length, "entry", "entries")}</span>
            </div>
            <Entries all={shown} />
          </>)}
      </Panel>
    </>);
}
