// SPDX-License-Identifier: Apache-2.0
// All variables of a board as a tree, with values that are updated when they change.

import { useMemo, useState } from "preact/hooks";
import { board_path, get } from "../../api/http";
import type { Variables as VariableList } from "../../api/types";
import { NoBoard } from "../../shell/no_board";
import { useBoard } from "../../shell/plant";
import { change_query, place } from "../../ui/address";
import { plural } from "../../ui/format";
import { Waiting } from "../../ui/parts";
import { part_named } from "../../ui/paths";
import { useRequest, useStore } from "../../ui/store";
import { Detail } from "./detail";
import { Forces } from "./forces";
import { useLive } from "./live";
import { matching, rows_of, type Row } from "./rows";
import { Tree } from "./tree";

const PURPOSE = "This view shows the variables that modules share, and sets and forces them.";
const OFTEN_MS = 3000;
const RARELY_MS = 20000;
const MANY = 500;

function with_change(set: Set<string>, key: string, inside: boolean): Set<string> {
  const next = new Set(set);
  if (inside) next.add(key);
  else next.delete(key);
  return next;
}

export function Variables() {
  const board = useBoard();
  const { query } = useStore(place);
  const search = query.get("q") ?? "";
  const chosen = query.get("v") ?? "";
  const [open, set_open] = useState(new Set<string>());
  const [closed, set_closed] = useState(new Set<string>());
  const [visible, set_visible] = useState<string[]>([]);
  const [every_ms, set_every_ms] = useState(OFTEN_MS);
  const key = board ? `${board.board} ${board.layout}` : "";
  const { value, error, refresh } = useRequest(key, every_ms, async () => {
    const answer = await get<VariableList>(board_path(board!.board, "/variables?values=false"));
    set_every_ms(answer.variables.length > MANY ? RARELY_MS : OFTEN_MS);
    return answer;
  });
  const variables = value?.variables ?? [];
  const rows = useMemo(() => rows_of(variables, search, open, closed), [variables, search, open, closed]);
  const found = useMemo(() => matching(variables, search).length, [variables, search]);
  const chosen_part = useMemo(() => (chosen ? part_named(variables, chosen) : null), [variables, chosen]);
  const wanted = chosen_part && !visible.includes(chosen_part.variable.name) ? [...visible, chosen_part.variable.name] : visible;
  const live = useLive(board?.board ?? "", wanted);
  const ages = useMemo(() => new Map(variables.map(({ name, age_ns }) => [name, age_ns])), [variables]);
  if (!board) return <NoBoard purpose={PURPOSE} />;
  const age_of = (name: string) => ages.get(name) ?? null;
  const toggle = (row: Row, to: boolean) => {
    if (row.part) set_open(with_change(open, row.key, to));
    set_closed(with_change(closed, row.key, !to));
  };
  const choose = (row: Row) => {
    if (row.part) change_query({ v: row.key });
    else set_closed(with_change(closed, row.key, row.open));
  };
  return (
    <>
      <Forces board={board.board} />
      <div class="bar">
        <label class="search"><span class="hidden">Search variables</span>
          <input type="search" placeholder="Search names and descriptions" value={search}
            onInput={(event) => change_query({ q: event.currentTarget.value })} /></label>
        <span class="quiet" role="status">{value ? (search ? `${found} of ${plural(variables.length, "variable")}` : plural(variables.length, "variable")) : ""}</span>
      </div>
      {error && <p class="bad">{error}</p>}
      {live.rejected && <p class="bad">{live.rejected}</p>}
      {!value && !error && <Waiting />}
      {value && variables.length === 0 && <p class="quiet">{PURPOSE} This board has none: they are declared in a <code>.glb</code> file.</p>}
      {value && variables.length > 0 && found === 0 && <p>No variable matches '{search}'.</p>}
      {rows.length > 0 && (
        <div class={`variables ${chosen_part ? "with-detail" : ""}`}>
          <Tree rows={rows} chosen={chosen} live={live} age_of={age_of} choose={choose} toggle={toggle} show_names={set_visible} />
          {chosen_part && <Detail board={board.board} part={chosen_part} live={live} close={() => change_query({ v: "" })} changed={refresh} />}
        </div>)}
    </>);
}
