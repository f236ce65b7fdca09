// SPDX-License-Identifier: Apache-2.0
// The users who may sign in, what they may do, and their open sessions. For the role administer.

import { useState } from "preact/hooks";
import { get, message_of, post } from "../../api/http";
import type { User } from "../../api/types";
import { plural, span } from "../../ui/format";
import { DataTable, Panel, Waiting } from "../../ui/parts";
import { useRequest } from "../../ui/store";

const EVERY_MS = 5000;
const SECOND_NS = 1e9;

// Returns a duration in whole seconds.
function seconds(ns: number): string {
  return ns < SECOND_NS ? "1 s" : span(Math.round(ns / SECOND_NS) * SECOND_NS);
}

function Sessions({ user }: { user: User }) {
  if (user.sessions.length === 0) return <span class="quiet">none</span>;
  return <>{user.sessions.map(({ from, since_ns, idle_ns }, i) => (
    <small key={i}>from {from}, for {seconds(since_ns)}, last request {idle_ns < SECOND_NS ? "now" : `${seconds(idle_ns)} ago`}</small>))}</>;
}

function limits(patterns: string[]): string {
  return patterns.length > 0 ? patterns.join(" ") : "all";
}

export function Users() {
  const { value, error, refresh } = useRequest("users", EVERY_MS, () => get<{ users: User[] }>("users"));
  const [result, set_result] = useState<{ text: string; bad: boolean }>({ text: "", bad: false });
  if (!value) return error ? <p class="bad">{error}</p> : <Waiting />;
  const end = async (user: string) => {
    try {
      const { ended } = await post<{ ended: number }>(`users/${encodeURIComponent(user)}/end`, {});
      set_result({ text: `${user}: ${plural(ended, "session")} ended.`, bad: false });
    } catch (problem) {
      set_result({ text: message_of(problem), bad: true });
    }
    refresh();
  };
  return (
    <Panel title="Users">
      {error && <p class="bad">{error}</p>}
      <DataTable label="Users">
        <thead><tr><th scope="col">User</th><th scope="col">Role</th><th scope="col">Boards</th><th scope="col">Variables</th>
          <th scope="col">Signs in with</th><th scope="col">Sessions</th><th scope="col">End</th></tr></thead>
        <tbody>{value.users.map((one) => (
          <tr key={one.user}>
            <th scope="row">{one.user}</th><td>{one.role}</td><td>{limits(one.boards)}</td><td>{limits(one.variables)}</td>
            <td>{[one.password && "password", one.token && "token"].filter(Boolean).join(", ") || "nothing"}</td>
            <td class="sessions"><Sessions user={one} /></td>
            <td>{one.sessions.length > 0 && <button type="button" aria-label={`End the sessions of ${one.user}`} onClick={() => void end(one.user)}>End</button>}</td>
          </tr>))}
        </tbody>
      </DataTable>
      <p role="status" class={result.bad ? "bad" : "good"}>{result.text}</p>
      <p class="quiet">Users are added and removed, and get roles and passwords, with: indurop users</p>
    </Panel>);
}
