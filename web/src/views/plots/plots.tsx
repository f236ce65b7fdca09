// SPDX-License-Identifier: Apache-2.0
// Values over time. All charts show the same time; what is shown is in the address.

import "uplot/dist/uPlot.min.css";
import "./plots.css";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type uPlot from "uplot";
import { board_path, get, words } from "../../api/http";
import type { Variables } from "../../api/types";
import { useBoard } from "../../shell/plant";
import { change_query, place } from "../../ui/address";
import { plural } from "../../ui/format";
import { Waiting } from "../../ui/parts";
import { is_number, part_named } from "../../ui/paths";
import { useAsked, useStore } from "../../ui/store";
import { Chart, type Shown } from "./chart";
import { save_csv, save_png } from "./export";
import { layout_of, RATES_HZ, show_charts, WINDOWS_S } from "./layout";
import { Picker } from "./picker";
import { Recorder } from "./recorder";

const DRAW_MS = 80;
const DRAW_MANY_MS = 500;
const MANY = 15_000;

function Choice({ label, value, of, unit, choose }: { label: string; value: number; of: number[]; unit: string; choose: (text: string) => void }) {
  return (
    <label class="choice">{label}{" "}
      <select value={value} onChange={(event) => choose(event.currentTarget.value)}>
        {of.map((one) => <option key={one} value={one}>{one} {unit}</option>)}
      </select>
    </label>);
}

// Draws while the charts follow; a chart that is paused is drawn when something else changes.
function useClock(running: boolean, recorder: Recorder): number {
  const [drawn, set] = useState(0);
  useEffect(() => {
    if (!running) return set((n) => n + 1);
    let timer = 0;
    const turn = () => {
      if (!document.hidden) set((n) => n + 1);
      timer = window.setTimeout(turn, recorder.size > MANY ? DRAW_MANY_MS : DRAW_MS);
    };
    turn();
    return () => clearTimeout(timer);
  }, [running]);
  return drawn;
}

export function Plots() {
  const board = useBoard();
  const { query } = useStore(place);
  const { charts, window_s, rate_hz } = layout_of(query);
  const [paused, pause] = useState<Shown | null>(null);
  const [marks, set_marks] = useState<number[]>([]);
  const plots = useRef(new Map<number, uPlot>());
  const recorder = useMemo(() => new Recorder(), [board?.board]);
  const names = [...new Set(charts.flat())];
  const asked = useAsked(board ? `${board.board} ${board.layout}` : "", 0,
    () => get<Variables>(board_path(board!.board, "/variables?values=false")), words);
  const variables = asked.value?.variables ?? [];
  const parts = useMemo(() => new Map(names.map((name) => [name, part_named(variables, name)])), [variables, names.join()]);
  const drawable = names.filter((name) => { const part = parts.get(name); return part && is_number(part); });
  useEffect(() => {
    recorder.follow(board?.board ?? "", drawable, rate_hz);
    return () => recorder.stop();
  }, [recorder, board?.board, drawable.join(), rate_hz]);
  const drawn = useClock(!paused, recorder);
  if (!board) return <Waiting />;

  const newest = () => (recorder.size > 0 ? recorder.times[recorder.size - 1] : Date.now() / 1000);
  const shown = (): Shown => paused ?? { from: newest() - window_s, to: newest() };
  const zoom_by = (factor: number) => {
    const { from, to } = shown();
    const half = (to - from) * factor / 2;
    pause({ from: (from + to) / 2 - half, to: (from + to) / 2 + half });
  };
  const move_by = (share: number) => {
    const { from, to } = shown();
    pause({ from: from + (to - from) * share, to: to + (to - from) * share });
  };
  const mark = (at: number) => set_marks(marks.length === 2 ? [] : [...marks, at].sort((a, b) => a - b));
  const add = (name: string, to: number) => {
    if (!name || !part_named(variables, name)) return;
    const next = charts.length > to ? charts.map((one, i) => (i === to && !one.includes(name) ? [...one, name] : one)) : [...charts, [name]];
    show_charts(next);
  };
  const lines = names.map((name) => ({ name, part: parts.get(name) ?? null }));
  const unknown = variables.length > 0 ? names.filter((name) => !parts.get(name)) : [];
  return (
    <>
      <div class="bar">
        <button type="button" aria-pressed={!!paused} onClick={() => pause(paused ? null : shown())}>{paused ? "Go on" : "Pause"}</button>
        <Choice label="Window" value={window_s} of={WINDOWS_S} unit="s" choose={(w) => { change_query({ w }); pause(null); }} />
        <Choice label="Rate" value={rate_hz} of={RATES_HZ} unit="Hz" choose={(hz) => change_query({ hz })} />
        <span class="group">
          <button type="button" aria-label="Zoom in" onClick={() => zoom_by(0.5)}>+</button>
          <button type="button" aria-label="Zoom out" onClick={() => zoom_by(2)}>{"\u2212"}</button>
          <button type="button" aria-label="Earlier" onClick={() => move_by(-0.5)}>{"\u25c2"}</button>
          <button type="button" aria-label="Later" onClick={() => move_by(0.5)}>{"\u25b8"}</button>
        </span>
        <button type="button" disabled={names.length === 0} onClick={() => save_csv(recorder, lines, shown())}>CSV</button>
        <button type="button" disabled={names.length === 0} onClick={() => save_png([...plots.current.values()])}>PNG</button>
        {marks.length > 0 && <button type="button" onClick={() => set_marks([])}>Clear marks</button>}
        <span class="quiet" role="status">
          {paused ? "Paused; values are still kept." : ""}
          {recorder.dropped > 0 && ` ${plural(recorder.dropped, "sample")} lost: this browser is too slow for the rate.`}
        </span>
      </div>
      {recorder.refused && <p class="bad">{recorder.refused}</p>}
      {recorder.missing.map((text) => <p class="warn" key={text}>{text}</p>)}
      {unknown.length > 0 && <p class="warn">This board has no {unknown.join(", ")}.</p>}
      <div class="plots">
        <div>
          {charts.length === 0 && <p class="panel">No chart yet. Click a number, or drag it here, to see it over time. The link in the address bar keeps your charts.</p>}
          {charts.map((chart, index) => (
            <Chart key={index} index={index} lines={chart.map((name) => ({ name, part: parts.get(name) ?? null }))} recorder={recorder} shown={shown}
              drawn={drawn} marks={marks} zoom={pause} live={() => { pause(null); set_marks([]); }} mark={mark}
              remove={(name) => show_charts(charts.map((one, i) => (i === index ? one.filter((other) => other !== name) : one)))}
              drop={(name) => add(name, index)}
              made={(plot) => { if (plot) plots.current.set(index, plot); else plots.current.delete(index); }} />))}
          <p class="panel drop" onDragOver={(event) => event.preventDefault()}
            onDrop={(event) => { event.preventDefault(); add(event.dataTransfer?.getData("text/plain") ?? "", charts.length); }}>
            Drag a number here for a new chart. In a chart: drag over a part of it to zoom, double-click to go on, click twice to measure.</p>
        </div>
        {asked.error ? <p class="bad">{asked.error}</p> : <Picker variables={variables} add={(name) => add(name, Math.max(0, charts.length - 1))} />}
      </div>
    </>);
}
