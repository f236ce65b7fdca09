// SPDX-License-Identifier: Apache-2.0
// Strip charts: values of the last seconds as they arrive, or earlier values while the charts are paused.

import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type uPlot from "uplot";
import type { BoardSummary } from "../../api/types";
import { change_query } from "../../ui/address";
import { plural } from "../../ui/format";
import { Chart, type Line, type Shown } from "./chart";
import { Choice } from "./choice";
import { save_csv, save_png } from "./export";
import { type Layout, RATES_HZ, WINDOWS_S } from "./layout";
import { Recorder } from "./recorder";

const DRAW_MS = 80;
const DRAW_MANY_MS = 500;
const MANY = 15_000;

// Counts the drawings of running charts. A paused chart is drawn when something else changes.
function useDrawings(running: boolean, recorder: Recorder): number {
  const [drawn, set_drawn] = useState(0);
  useEffect(() => {
    if (!running) return set_drawn((n) => n + 1);
    let timer = 0;
    const draw = () => {
      if (!document.hidden) set_drawn((n) => n + 1);
      timer = window.setTimeout(draw, recorder.size > MANY ? DRAW_MANY_MS : DRAW_MS);
    };
    draw();
    return () => clearTimeout(timer);
  }, [running]);
  return drawn;
}

interface Props {
  board: BoardSummary;
  layout: Layout;
  drawable: string[];
  line: (name: string) => Line;
  remove: (index: number, name: string) => void;
  drop: (name: string, index: number) => void;
}

export function Strip({ board, layout: { charts, window_s, rate_hz }, drawable, line, remove, drop }: Props) {
  const [paused, set_paused] = useState<Shown | null>(null);
  const [marks, set_marks] = useState<number[]>([]);
  const plots = useRef(new Map<number, uPlot>());
  const recorder = useMemo(() => new Recorder(), [board.board]);
  useEffect(() => {
    recorder.follow(board.board, drawable, rate_hz);
    return () => recorder.stop();
  }, [recorder, board.board, drawable.join(), rate_hz]);
  const drawn = useDrawings(!paused, recorder);

  const newest = () => (recorder.size > 0 ? recorder.times[recorder.size - 1] : Date.now() / 1000);
  const shown = (): Shown => paused ?? { from: newest() - window_s, to: newest() };
  const zoom_by = (factor: number) => {
    const { from, to } = shown();
    const half = (to - from) * factor / 2;
    set_paused({ from: (from + to) / 2 - half, to: (from + to) / 2 + half });
  };
  const move_by = (share: number) => {
    const { from, to } = shown();
    set_paused({ from: from + (to - from) * share, to: to + (to - from) * share });
  };
  const lines = [...new Set(charts.flat())].map(line);
  return (
    <>
      <div class="bar">
        <button type="button" aria-pressed={!!paused} onClick={() => set_paused(paused ? null : shown())}>{paused ? "Resume" : "Pause"}</button>
        <Choice label="Window" value={window_s} of={WINDOWS_S} unit="s" choose={(w) => { change_query({ w }); set_paused(null); }} />
        <Choice label="Rate" value={rate_hz} of={RATES_HZ} unit="Hz" choose={(hz) => change_query({ hz })} />
        <span class="group">
          <button type="button" aria-label="Zoom in" onClick={() => zoom_by(0.5)}>+</button>
          <button type="button" aria-label="Zoom out" onClick={() => zoom_by(2)}>{"\u2212"}</button>
          <button type="button" aria-label="Earlier" onClick={() => move_by(-0.5)}>{"\u25c2"}</button>
          <button type="button" aria-label="Later" onClick={() => move_by(0.5)}>{"\u25b8"}</button>
        </span>
        <button type="button" disabled={lines.length === 0} onClick={() => save_csv(recorder, lines, shown())}>CSV</button>
        <button type="button" disabled={lines.length === 0} onClick={() => save_png([...plots.current.values()])}>PNG</button>
        {marks.length > 0 && <button type="button" onClick={() => set_marks([])}>Clear marks</button>}
        <span class="quiet" role="status">
          {paused ? "Paused; values are still recorded." : ""}
          {recorder.dropped > 0 && ` ${plural(recorder.dropped, "sample")} lost: this browser is too slow for the rate.`}
        </span>
      </div>
      {recorder.rejected && <p class="bad">{recorder.rejected}</p>}
      {recorder.missing.map((text) => <p class="warn" key={text}>{text}</p>)}
      {charts.map((chart, index) => (
        <Chart key={index} index={index} lines={chart.map(line)} recorder={recorder} shown={shown}
          drawn={drawn} marks={marks} zoom={set_paused} live={() => { set_paused(null); set_marks([]); }}
          mark={(at) => set_marks(marks.length === 2 ? [] : [...marks, at].sort((a, b) => a - b))}
          remove={(name) => remove(index, name)} drop={(name) => drop(name, index)}
          set_plot={(plot) => { if (plot) plots.current.set(index, plot); else plots.current.delete(index); }} />))}
    </>);
}
