// SPDX-License-Identifier: Apache-2.0
// The tree of variables. Only visible lines are created, so 5 000 variables cost as much as fifty.

import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Quality } from "../../api/types";
import { letter_px } from "../../shell/theme";
import { plural, span, value_text } from "../../ui/format";
import { value_in } from "../../ui/paths";
import type { Live } from "./live";
import type { Row } from "./rows";

const ROW_REM = 2;
const SPARE = 6;  // lines created above and below the visible ones

interface Props {
  rows: Row[];
  chosen: string;
  live: Live;
  age_of: (name: string) => number | null;
  choose: (row: Row) => void;
  toggle: (row: Row, open: boolean) => void;
  show_names: (names: string[]) => void;  // called with the variables of the visible lines
}

function quality_text(quality: Quality): string {
  return { good: "", stale: "stale", silent: "board is silent", unread: "unread" }[quality];
}

function Cells({ row, live, age }: { row: Row; live: Live; age: number | null }) {
  const { part } = row;
  if (!part) return <><span role="gridcell" class="value quiet">{plural(row.inside ?? 0, "variable")}</span><span role="gridcell" class="unit" /><span role="gridcell" class="marks" /></>;
  const { name } = part.variable;
  const value = value_in(live.values.get(name), name, part.name);
  const quality = quality_text(live.quality.get(name) ?? "good");
  const forced = live.forced.has(part.name) || live.forced.has(name) || part.variable.forced.some((one) => one.startsWith(part.name));
  return (
    <>
      <span role="gridcell" class={`value ${quality ? "old" : ""}`}>{value_text(value, part.form.enumerators)}</span>
      <span role="gridcell" class="unit">{part.unit}</span>
      <span role="gridcell" class="marks">
        {forced && <span class="chip warn">forced</span>}
        {quality && <span class="chip bad">{quality}</span>}
        {age !== null && <span class="age">{span(age)} old</span>}
      </span>
    </>);
}

export function Tree({ rows, chosen, live, age_of, choose, toggle, show_names }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const [top, set_top] = useState(0);
  const [height, set_height] = useState(600);
  const [row_px, set_row_px] = useState(32);
  useLayoutEffect(() => {
    const measure = () => {
      set_row_px(ROW_REM * letter_px());
      set_height(box.current?.clientHeight ?? 600);
    };
    measure();
    const watch = new ResizeObserver(measure);
    watch.observe(box.current!);
    return () => watch.disconnect();
  }, []);
  const first = Math.max(0, Math.floor(top / row_px) - SPARE);
  const last = Math.min(rows.length, Math.ceil((top + height) / row_px) + SPARE);
  const shown = rows.slice(first, last);
  const names = [...new Set(shown.flatMap(({ part }) => (part ? [part.variable.name] : [])))].join(",");
  useEffect(() => show_names(names ? names.split(",") : []), [names]);

  // The line that keys act on; the selected one is shown in the details next to the tree.
  const [active, set_active] = useState(chosen);
  const at = rows.findIndex(({ key }) => key === active);
  const move_to = (to: number) => {
    const next = rows[Math.max(0, Math.min(rows.length - 1, to))];
    if (!next || !box.current) return;
    set_active(next.key);
    const y = rows.indexOf(next) * row_px;
    if (y < box.current.scrollTop) box.current.scrollTop = y;
    else if (y + row_px > box.current.scrollTop + height) box.current.scrollTop = y + row_px - height;
  };
  const handle_key = (event: KeyboardEvent) => {
    const row = rows[at];
    const page = Math.max(1, Math.floor(height / row_px) - 1);
    const moves: Record<string, () => void> = {
      ArrowDown: () => move_to(at + 1), ArrowUp: () => move_to(at - 1), PageDown: () => move_to(at + page), PageUp: () => move_to(at - page),
      Home: () => move_to(0), End: () => move_to(rows.length - 1),
      ArrowRight: () => (row?.opens && !row.open ? toggle(row, true) : move_to(at + 1)),
      ArrowLeft: () => {
        if (row?.opens && row.open) return toggle(row, false);
        for (let up = at - 1; row && up >= 0; up--) if (rows[up].level < row.level) return move_to(up);
      },
      Enter: () => row && choose(row),
      " ": () => row?.opens && toggle(row, !row.open),
    };
    if (!moves[event.key]) return;
    event.preventDefault();
    moves[event.key]();
  };
  return (
    <div class="tree" role="treegrid" aria-label="Variables" aria-rowcount={rows.length} tabIndex={0} ref={box} onKeyDown={handle_key}
      aria-activedescendant={at >= first && at < last ? `row-${at}` : undefined} onScroll={() => set_top(box.current!.scrollTop)}>
      <div role="row" class="heads">
        {["Name", "Value", "Unit", "State"].map((head) => <span key={head} role="columnheader">{head}</span>)}
      </div>
      <div role="presentation" class="lines" style={{ height: `${rows.length * row_px}px` }}>
        {shown.map((row, i) => (
          <div key={row.key} id={`row-${first + i}`} role="row" aria-level={row.level} aria-rowindex={first + i + 1}
            aria-expanded={row.opens ? row.open : undefined} aria-selected={row.key === chosen} class={`line ${row.key === active ? "active" : ""}`}
            style={{ top: `${(first + i) * row_px}px`, height: `${row_px}px` }}
            onClick={() => { set_active(row.key); choose(row); }} onDblClick={() => row.part && row.opens && toggle(row, !row.open)}>
            <span role="gridcell" class="name" style={{ paddingLeft: `${(row.level - 1) * 1.1}rem` }} title={row.part?.name ?? row.key}>
              <span class="opener" aria-hidden="true" onClick={(event) => { if (row.opens) { event.stopPropagation(); toggle(row, !row.open); } }}>
                {row.opens ? (row.open ? "\u25be" : "\u25b8") : ""}</span>
              {row.label}
            </span>
            <Cells row={row} live={live} age={row.part ? age_of(row.part.variable.name) : null} />
          </div>))}
      </div>
    </div>);
}
