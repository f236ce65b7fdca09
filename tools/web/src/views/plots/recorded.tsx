// SPDX-License-Identifier: Apache-2.0
// Charts of a recording or black box. Zooming in requests that part again, in more detail.

import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type uPlot from "uplot";
import { get, message_of } from "../../api/http";
import type { RecordedTick, RecordedValues, RecordingContents, RecordingFile } from "../../api/types";
import { change_query } from "../../ui/address";
import { clock, span } from "../../ui/format";
import { Waiting } from "../../ui/parts";
import type { Part } from "../../ui/paths";
import { useRequest } from "../../ui/store";
import { Chart, type Line, type Shown, type Stepped } from "./chart";
import { csv_of, save_png, save_text } from "./export";
import { show_charts } from "./layout";
import { Picker } from "./picker";
import type { Samples } from "./recorder";
import { StepBar, TickDetails } from "./step";

const POINTS = 3000;
const TIMEOUT_MS = 60_000;

class RecordedSamples implements Samples {
  readonly size: number;
  readonly times: Float64Array;
  readonly board_times: Float64Array;
  private readonly columns: Map<string, Float64Array>;

  constructor({ begin_ns, end_ns, lines }: RecordedValues) {
    this.size = lines[0]?.values.length ?? 0;
    const step = this.size > 1 ? (end_ns - begin_ns) / (this.size - 1) : 0;
    this.times = Float64Array.from({ length: this.size }, (_, i) => (begin_ns + i * step) / 1e9);
    this.board_times = this.times;
    this.columns = new Map(lines.map(({ name, values }) => [name, Float64Array.from(values, (value) => value ?? NaN)]));
  }
  column(name: string): Float64Array | undefined { return this.columns.get(name); }
  index_at(time: number): number {
    const found = this.times.findIndex((one) => one >= time);
    return found < 0 ? this.size : found;
  }
}

const EMPTY = new RecordedSamples({ begin_ns: 0, end_ns: 0, lines: [] });

function path(name: string, rest = ""): string {
  return `recordings/${encodeURIComponent(name)}${rest}`;
}

function label({ name, reason, wall_ns, black_box }: RecordingFile): string {
  return `${clock(wall_ns)}  ${name}${black_box && reason ? `: ${reason}` : ""}`;
}

// The tick that was selected, as shown in charts.
function stepped({ tick, end_ns, numbers }: RecordedTick): Stepped {
  return { time: end_ns / 1e9, name: `tick ${tick}`, numbers: new Map(numbers.map(({ name, value }) => [name, value ?? NaN])) };
}

// The same length of time around the tick, if it is not in the part that is shown.
function moved_to(at: number, shown: Shown): Shown {
  const half = (shown.to - shown.from) / 2;
  return at >= shown.from && at <= shown.to ? shown : { from: at - half, to: at + half };
}

export function Recorded({ charts, name, tick, board }: { charts: string[][]; name: string; tick: string; board: string }) {
  const all = useRequest("recordings", 5000, () => get<{ recordings: RecordingFile[] }>("recordings"));
  const inside = useRequest(name && `recording ${name}`, 0, () => get<RecordingContents>(path(name), TIMEOUT_MS));
  const [zoomed, set_zoomed] = useState<Shown | null>(null);
  const [marks, set_marks] = useState<number[]>([]);
  const [drawn, set_drawn] = useState(0);
  const [failed, set_failed] = useState("");  // a step to a time
  const plots = useRef(new Map<number, uPlot>());
  const units = useMemo(() => new Map(inside.value?.channels.flatMap(({ unit, numbers }) => numbers.map((one) => [one, unit] as const))), [inside.value]);
  const wanted = [...new Set(charts.flat())].filter((one) => units.has(one));
  const part = zoomed ? `&from_ns=${Math.floor(zoomed.from * 1e9)}&to_ns=${Math.ceil(zoomed.to * 1e9)}` : "";
  const query = `${wanted.map((one) => `&number=${encodeURIComponent(one)}`).join("")}${part}`;
  const values = useRequest(wanted.length > 0 ? `values ${name} ${query}` : "", 0,
    () => get<RecordedValues>(path(name, `/values?points=${POINTS}${query}`), TIMEOUT_MS));
  const samples = useMemo(() => (values.value ? new RecordedSamples(values.value) : null), [values.value]);
  const last = useRef<RecordedSamples>(EMPTY);
  if (samples) last.current = samples;
  useEffect(() => set_drawn((n) => n + 1), [samples, zoomed]);
  useEffect(() => set_zoomed(null), [name]);

  const whole = inside.value;
  const of_board = board || whole?.boards[0] || "";
  const at_tick = useRequest(whole && tick !== "" ? `tick ${name} ${of_board} ${tick} ${wanted}` : "", 0, () => get<RecordedTick>(
    path(name, `/tick?tick=${tick}&board=${encodeURIComponent(of_board)}${wanted.map((one) => `&number=${encodeURIComponent(one)}`).join("")}`), TIMEOUT_MS));
  const last_step = useRef<RecordedTick | null>(null);
  if (at_tick.value) last_step.current = at_tick.value;
  const step = tick === "" ? null : last_step.current;
  const marked = useMemo(() => step && stepped(step), [step]);
  useEffect(() => { if (zoomed && marked) set_zoomed(moved_to(marked.time, zoomed)); }, [marked]);
  useEffect(() => { last_step.current = null; }, [name, of_board]);
  const go = (to: number) => change_query({ t: String(to) });
  const go_to_time = (at: number) => {
    void get<RecordedTick>(path(name, `/tick?at_ns=${Math.max(0, Math.round(at * 1e9))}&board=${encodeURIComponent(of_board)}`), TIMEOUT_MS)
      .then((found) => { set_failed(""); go(found.tick); }, (error) => set_failed(message_of(error)));
  };
  const shown = (): Shown => zoomed ?? { from: (whole?.begin_ns ?? 0) / 1e9, to: (whole?.end_ns ?? 1e9) / 1e9 };
  const line = (one: string): Line => ({ name: one, part: units.has(one) ? { unit: units.get(one), form: { kind: "f64", size: 8 } } as Part : null });
  const add = (one: string, to: number) => {
    if (!units.has(one)) return;
    show_charts(charts.length > to ? charts.map((names, i) => (i === to && !names.includes(one) ? [...names, one] : names)) : [...charts, [one]]);
  };
  return (
    <>
      <div class="bar">
        <label class="choice recording">Recording{" "}
          <select value={name} onChange={(event) => change_query({ r: event.currentTarget.value, t: "", b: "" })}>
            <option value="">select one</option>
            {all.value?.recordings.map((one) => <option key={one.name} value={one.name}>{label(one)}</option>)}
          </select></label>
        {zoomed && <button type="button" onClick={() => set_zoomed(null)}>All</button>}
        <button type="button" disabled={!samples} onClick={() => samples && save_text(csv_of(samples, wanted.map(line), shown()))}>CSV</button>
        <button type="button" disabled={!samples} onClick={() => save_png([...plots.current.values()])}>PNG</button>
        {whole && tick === "" && <button type="button" onClick={() => go_to_time(marks[0] ?? shown().to)}>Step</button>}
        {whole && whole.boards.length > 0 && tick !== "" && (
          <label class="choice">Board{" "}
            <select value={of_board} onChange={(event) => change_query({ b: event.currentTarget.value })}>
              {whole.boards.map((one) => <option key={one} value={one}>{one}</option>)}
            </select></label>)}
        {marks.length > 0 && <button type="button" onClick={() => set_marks([])}>Clear marks</button>}
      </div>
      {all.value?.recordings.length === 0 && <p class="quiet">There are no recordings. A node writes a black box when a module faults. To show the files of indurop record, start the
        server with: indurop serve --recordings DIR</p>}
      {[all.error, inside.error, values.error, failed].filter(Boolean).map((text) => <p class="bad" key={text}>{text}</p>)}
      {name && !whole && !inside.error && <Waiting />}
      {whole && (
        <>
          <p class="quiet" role="status">{span(whole.end_ns - whole.begin_ns)} from {clock(whole.begin_ns)}{whole.reason && `: ${whole.reason}`}
            {whole.complete ? "" : ". The file was not closed."}</p>
          <div class="plots">
            <div>
              {tick !== "" && <StepBar step={step} error={at_tick.error} go={go} close={() => change_query({ t: "", b: "" })} />}
              {charts.length === 0 && <p class="panel">To begin, click a number, or drag it here.</p>}
              {charts.map((chart, index) => (
                <Chart key={index} index={index} lines={chart.map(line)} recorder={last.current} shown={shown} drawn={drawn} marks={marks} step={marked} zoom={set_zoomed}
                  live={() => { set_zoomed(null); set_marks([]); }} mark={(at) => tick !== "" ? go_to_time(at) : set_marks(marks.length === 2 ? [] : [...marks, at].sort((a, b) => a - b))}
                  remove={(one) => show_charts(charts.map((names, i) => (i === index ? names.filter((other) => other !== one) : names)))}
                  drop={(one) => add(one, index)} set_plot={(plot) => { if (plot) plots.current.set(index, plot); else plots.current.delete(index); }} />))}
              <p class="panel drop" onDragOver={(event) => event.preventDefault()}
                onDrop={(event) => { event.preventDefault(); add(event.dataTransfer?.getData("text/plain") ?? "", charts.length); }}>
                Drag a number here for a new chart. In a chart: drag over a part of it to zoom, double-click to see all, click twice to measure.</p>
              {step && <TickDetails path={path(name)} board={of_board} step={step} />}
            </div>
            <Picker names={[...units.keys()].sort()} add={(one) => add(one, Math.max(0, charts.length - 1))} />
          </div>
        </>)}
    </>);
}
