// SPDX-License-Identifier: Apache-2.0
// Values over time, as strips or around a trigger. All charts show the same time; the address names what they show.

import { useMemo } from "preact/hooks";
import { board_path, get } from "../../api/http";
import type { Variables } from "../../api/types";
import { NoBoard } from "../../shell/no_board";
import { useBoard } from "../../shell/plant";
import { change_query, place } from "../../ui/address";
import { is_number, numbers_of, part_named, whole } from "../../ui/paths";
import { useRequest, useStore } from "../../ui/store";
import { Choice } from "./choice";
import { layout_of, MODES, show_charts, scope_of } from "./layout";
import { Picker } from "./picker";
import { Recorded } from "./recorded";
import { Strip } from "./strip";
import { Triggered } from "./triggered";

const PURPOSE = "This view plots numbers over time: as they arrive, in every tick around a trigger, or from a recording.";
const HINTS = {
  strip: "Values as they arrive.",
  single: "Every tick around a trigger, once.",
  normal: "Every tick around each trigger.",
  auto: "Every tick around each trigger, or the newest ticks without one.",
  recording: "Recordings and black boxes.",
};

export function Plots() {
  const board = useBoard();
  const { query } = useStore(place);
  const layout = layout_of(query);
  const scope = scope_of(query);
  const { charts } = layout;
  const names = [...new Set(charts.flat())];
  const answer = useRequest(board ? `${board.board} ${board.layout}` : "", 0,
    () => get<Variables>(board_path(board!.board, "/variables?values=false")));
  const variables = answer.value?.variables ?? [];
  const parts = useMemo(() => new Map(names.map((name) => [name, part_named(variables, name)])), [variables, names.join()]);
  const numbers = useMemo(() => variables.flatMap((variable) => numbers_of(whole(variable))), [variables]);
  const choice = (
    <div class="bar"><Choice label="Show" value={scope.mode} of={MODES} choose={(m) => change_query({ m: m === "strip" ? "" : m })} />
      <span class="quiet">{HINTS[scope.mode]}</span></div>);
  if (scope.mode === "recording") return <>{choice}<Recorded charts={charts} name={query.get("r") ?? ""} tick={query.get("t") ?? ""} board={query.get("b") ?? ""} /></>;
  if (!board) return <>{choice}<NoBoard purpose={PURPOSE} /></>;

  const drawable = names.filter((name) => { const part = parts.get(name); return part && is_number(part); });
  const add = (name: string, to: number) => {
    if (!name || !part_named(variables, name)) return;
    const next = charts.length > to ? charts.map((one, i) => (i === to && !one.includes(name) ? [...one, name] : one)) : [...charts, [name]];
    show_charts(next);
  };
  const shared = {
    board, drawable,
    line: (name: string) => ({ name, part: parts.get(name) ?? null }),
    remove: (index: number, name: string) => show_charts(charts.map((one, i) => (i === index ? one.filter((other) => other !== name) : one))),
    drop: add,
  };
  const unknown = variables.length > 0 ? names.filter((name) => !parts.get(name)) : [];
  return (
    <>
      {choice}
      {unknown.length > 0 && <p class="warn">This board has no {unknown.join(", ")}.</p>}
      <div class="plots">
        <div>
          {charts.length === 0 && (scope.mode === "strip" || scope.expressions.length === 0) && <p class="panel">{PURPOSE} To begin, click a number, or drag it here. The address keeps the charts.</p>}
          {scope.mode === "strip" ? <Strip {...shared} layout={layout} /> : <Triggered {...shared} scope={scope} charts={charts} />}
          <p class="panel drop" onDragOver={(event) => event.preventDefault()}
            onDrop={(event) => { event.preventDefault(); add(event.dataTransfer?.getData("text/plain") ?? "", charts.length); }}>
            Drag a number here for a new chart. In a chart: drag over a part of it to zoom, double-click to resume, click twice to measure.</p>
        </div>
        {answer.error ? <p class="bad">{answer.error}</p> : <Picker names={numbers} add={(name) => add(name, Math.max(0, charts.length - 1))} />}
      </div>
    </>);
}
