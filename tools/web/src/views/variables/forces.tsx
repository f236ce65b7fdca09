// SPDX-License-Identifier: Apache-2.0
// What is forced, by whom and why, and the lock that keeps a board from being written to.

import { useState } from "preact/hooks";
import { board_path, get, post, words } from "../../api/http";
import type { Force, Lock } from "../../api/types";
import { leases } from "../../shell/leases";
import { plant } from "../../shell/plant";
import { change_query } from "../../ui/address";
import { plural, span, value_text } from "../../ui/format";
import { useAsked, useStore } from "../../ui/store";

const EVERY_MS = 2000;
const MEANING = { none: "may be written", tune: "parameters alone may be written", all: "nothing may be written" };

function by({ who, from, reason }: { who?: string; from?: string; reason?: string }): string {
  const whom = who ? `, by ${who}${from ? ` (${from})` : ""}` : "";
  return whom + (reason ? `: ${reason}` : "");
}

function how_long({ left_ns, lease }: Force): string {
  if (lease) return "as long as its client is there";
  return left_ns === null ? "until released" : `for ${span(left_ns)} more`;
}

export function Forces({ board }: { board: string }) {
  const { status } = useStore(plant);
  const { lost } = useStore(leases);
  const { value, again } = useAsked(board, EVERY_MS,
    () => get<{ forces: Force[]; lock: Lock }>(board_path(board, "/forces")), words);
  const [said, say] = useState("");
  if (!value) return null;
  const order = async (path: string, body: object) => {
    try {
      await post(board_path(board, path), body);
      say("");
    } catch (error) {
      say(words(error));
    }
    again();
  };
  const { forces, lock } = value;
  return (
    <>
      {(status?.may_write || lock.lock !== "none") && (
        <p class={`bar lock ${lock.lock === "none" ? "quiet" : ""}`}>
          {status?.may_write
            ? <label>Write lock <select value={lock.lock} onChange={(event) => order("/lock", { lock: event.currentTarget.value })}>
                {Object.entries(MEANING).map(([word, meaning]) => <option key={word} value={word}>{`${word}: ${meaning}`}</option>)}
              </select></label>
            : `Write lock ${lock.lock}: ${MEANING[lock.lock]}`}
          {lock.lock !== "none" && <span>{by(lock).replace(/^, /, "")}</span>}
        </p>)}
      {said && <p class="bad" role="alert">{said}</p>}
      {lost && <p class="warn" role="alert">Not held by this page any more: {lost}</p>}
      {forces.length > 0 && (
        <section class="panel forces" aria-label="Forced values">
          <h2>{plural(forces.length, "value is", "values are")} forced</h2>
          <ul class="plain">
            {forces.map((one) => (
              <li key={one.name}>
                <a href={`#${one.name}`} onClick={(event) => { event.preventDefault(); change_query({ v: one.name }); }}>{one.name}</a> at {value_text(one.value)},{" "}
                {how_long(one)}{by(one)}{" "}
                {status?.may_write && <button type="button" onClick={() => order("/release", { names: [one.name] })} aria-label={`Release ${one.name}`}>release</button>}
              </li>))}
          </ul>
          {status?.may_write && forces.length > 1 && <button type="button" onClick={() => order("/release", { all: true })}>Release all</button>}
        </section>)}
    </>);
}
