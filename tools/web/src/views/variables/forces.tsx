// SPDX-License-Identifier: Apache-2.0
// Forced values with user and reason, and the board's write lock.

import { useState } from "preact/hooks";
import { board_path, get, message_of, post } from "../../api/http";
import type { Force, Lock } from "../../api/types";
import { leases } from "../../shell/leases";
import { useMay } from "../../shell/plant";
import { change_query } from "../../ui/address";
import { plural, span, value_text } from "../../ui/format";
import { useRequest, useStore } from "../../ui/store";

const EVERY_MS = 2000;
const MEANINGS = { none: "everything may be written", tune: "only parameters may be written", all: "nothing may be written" };

function user_text({ who, from, reason }: { who?: string; from?: string; reason?: string }): string {
  const user = who ? `, by ${who}${from ? ` (${from})` : ""}` : "";
  return user + (reason ? `: ${reason}` : "");
}

function duration_text({ left_ns, lease }: Force): string {
  if (lease) return "while the page that forced it is open";
  return left_ns === null ? "until released" : `for ${span(left_ns)} more`;
}

export function Forces({ board }: { board: string }) {
  const may_lock = useMay("program");
  const may_release = useMay("tune");
  const { lost } = useStore(leases);
  const { value, refresh } = useRequest(board, EVERY_MS,
    () => get<{ forces: Force[]; lock: Lock }>(board_path(board, "/forces")));
  const [problem, set_problem] = useState("");
  if (!value) return null;
  const send = async (path: string, body: object) => {
    try {
      await post(board_path(board, path), body);
      set_problem("");
    } catch (error) {
      set_problem(message_of(error));
    }
    refresh();
  };
  const { forces, lock } = value;
  return (
    <>
      {(may_lock || lock.lock !== "none") && (
        <p class={`bar lock ${lock.lock === "none" ? "quiet" : ""}`}>
          {may_lock
            ? <label>Write lock <select value={lock.lock} onChange={(event) => send("/lock", { lock: event.currentTarget.value })}>
                {Object.entries(MEANINGS).map(([word, meaning]) => <option key={word} value={word}>{`${word}: ${meaning}`}</option>)}
              </select></label>
            : `Write lock ${lock.lock}: ${MEANINGS[lock.lock]}`}
          {lock.lock !== "none" && <span>{user_text(lock).replace(/^, /, "")}</span>}
        </p>)}
      {problem && <p class="bad" role="alert">{problem}</p>}
      {lost && <p class="warn" role="alert">No longer forced by this page: {lost}</p>}
      {forces.length > 0 && (
        <section class="panel forces" aria-label="Forced values">
          <h2>{plural(forces.length, "value is", "values are")} forced</h2>
          <ul class="plain">
            {forces.map((one) => (
              <li key={one.name}>
                <a href={`#${one.name}`} onClick={(event) => { event.preventDefault(); change_query({ v: one.name }); }}>{one.name}</a> at {value_text(one.value)},{" "}
                {duration_text(one)}{user_text(one)}{" "}
                {may_release && <button type="button" onClick={() => send("/release", { names: [one.name] })} aria-label={`Release ${one.name}`}>release</button>}
              </li>))}
          </ul>
          {may_release && forces.length > 1 && <button type="button" onClick={() => send("/release", { all: true })}>Release all</button>}
        </section>)}
    </>);
}
