// SPDX-License-Identifier: Apache-2.0
// One chart: uPlot draws it, the legend shows values at the cursor (or the newest), two marks measure.

import { useEffect, useRef, useState } from "preact/hooks";
import uPlot from "uplot";
import { colour, colours_changed, letter_px } from "../../shell/theme";
import { short, value_text } from "../../ui/format";
import { Name } from "../../ui/parts";
import { is_number, type Part } from "../../ui/paths";
import { useStore } from "../../ui/store";
import type { Samples } from "./recorder";

const COLOURS = 8;
const MARKS = ["A", "B"];

export interface Shown {
  from: number;  // s since 1970
  to: number;
}

export interface Line {
  name: string;
  part: Part | null;
}

// The tick of a recording that is shown.
export interface Stepped {
  time: number;  // s since 1970
  name: string;
  numbers: Map<string, number>;  // the values then
}

interface Props {
  index: number;
  lines: Line[];
  recorder: Samples;
  relative?: boolean;  // times are seconds from the trigger, else since 1970
  shown: () => Shown;
  drawn: number;  // changes when the chart has to be drawn again
  marks: number[];
  step?: Stepped | null;
  zoom: (shown: Shown) => void;
  live: () => void;
  mark: (at: number) => void;
  remove: (name: string) => void;
  drop: (name: string) => void;
  set_plot: (plot: uPlot | null) => void;
}

// Times of the day: 14:05:09.250.
function times(_: uPlot, splits: number[], __: number, ___: number, step: number): string[] {
  return splits.map((time) => {
    const text = new Date(time * 1000).toTimeString().slice(0, 8);
    return step < 1 ? `${text}.${Math.round((time % 1) * 1000).toString().padStart(3, "0")}` : text;
  });
}

function seconds(_: uPlot, splits: number[], __: number, ___: number, step: number): string[] {
  const [size, unit] = step < 1e-3 ? [1e6, "us"] : step < 1 ? [1e3, "ms"] : [1, "s"];
  return splits.map((time) => `${Number((time * size).toPrecision(6))} ${unit}`);
}

function unit_of(line: Line): string {
  return line.part?.unit || "-";
}

function plain(column: Float64Array | undefined, from: number, to: number): (number | null)[] {
  const values: (number | null)[] = new Array(to - from);
  for (let i = from; i < to; i++) {
    const value = column ? column[i] : NaN;
    values[i - from] = Number.isNaN(value) ? null : value;
  }
  return values;
}

function data_of({ recorder, lines, shown }: Props): uPlot.AlignedData {
  const { from, to } = shown();
  const first = Math.max(0, recorder.index_at(from) - 1);
  const last = Math.min(recorder.size, recorder.index_at(to) + 1);
  return [Array.from(recorder.times.subarray(first, last)), ...lines.map(({ name }) => plain(recorder.column(name), first, last))];
}

// The values at a time: those of the last sample at or before it.
function values_at({ recorder, lines }: Props, time: number | null): number[] {
  const index = time === null ? recorder.size - 1 : recorder.index_at(time + 1e-9) - 1;
  return lines.map(({ name }) => (index < 0 ? NaN : recorder.column(name)?.[index] ?? NaN));
}

function options(props: () => Props, size: { width: number; height: number }, cursor: (time: number | null) => void): uPlot.Options {
  const { lines, relative } = props();
  const units = [...new Set(lines.map(unit_of))];
  const letter = letter_px();
  const font = `${Math.round(letter * 0.75)}px system-ui, sans-serif`;
  const axis = { font, labelFont: font, stroke: colour("quiet"), grid: { stroke: colour("grid"), width: 1 }, ticks: { stroke: colour("grid"), width: 1 } };
  return {
    ...size,
    legend: { show: false },
    cursor: { sync: { key: "plots" }, drag: { x: true, y: false, setScale: false }, points: { size: 7 } },
    scales: {
      x: { time: !relative, range: () => [props().shown().from, props().shown().to] },
      ...Object.fromEntries(units.map((unit) => [unit, { range: uPlotRange }])),
    },
    axes: [{ ...axis, values: relative ? seconds : times, space: letter * 6, size: letter * 2.2 }, ...units.slice(0, 2).map((unit, i) => ({
      ...axis, scale: unit, side: (i === 0 ? 3 : 1) as uPlot.Axis.Side, label: unit === "-" ? undefined : unit, labelSize: letter * 1.2, size: letter * 4,
      grid: { ...axis.grid, show: i === 0 },
    }))],
    series: [{}, ...lines.map((line, i) => ({
      label: line.name, scale: unit_of(line), stroke: colour(`c${i % COLOURS}`), width: 2,
      dash: i % 2 ? [8, 4] : undefined, points: { show: false },
      paths: line.part && !line.part.form.kind.startsWith("f") ? uPlot.paths.stepped!({ align: 1 }) : undefined,
    }))],
    hooks: {
      setSelect: [(plot) => {
        if (plot.select.width < 4) return;
        const from = plot.posToVal(plot.select.left, "x");
        const to = plot.posToVal(plot.select.left + plot.select.width, "x");
        plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        props().zoom({ from, to });
      }],
      setCursor: [(plot) => cursor(plot.cursor.left === undefined || plot.cursor.left < 0 ? null : plot.posToVal(plot.cursor.left, "x"))],
      draw: [(plot) => draw_marks(plot, props().marks, MARKS), (plot) => { const { step } = props(); if (step) draw_marks(plot, [step.time], [step.name]); }, (plot) => relative && draw_marks(plot, [0], ["T"])],
    },
  };
}

// Leaves space above and below, also for a constant line.
function uPlotRange(_: uPlot, min: number | null, max: number | null): uPlot.Range.MinMax {
  if (min === null || max === null) return [0, 1];
  if (min === max) return [min - Math.max(1, Math.abs(min) * 0.1), max + Math.max(1, Math.abs(max) * 0.1)];
  const space = (max - min) * 0.08;
  return [min - space, max + space];
}

function draw_marks({ ctx, bbox, valToPos }: uPlot, marks: number[], names: string[]): void {
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = colour("text");
  ctx.lineWidth = 1;
  ctx.textAlign = "left";
  marks.forEach((time, i) => {
    const x = Math.round(valToPos(time, "x", true));
    if (x < bbox.left || x > bbox.left + bbox.width) return;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.fillText(names[i], x + 4, bbox.top + 12 * devicePixelRatio);
  });
  ctx.restore();
}

function shown_value(line: Line, value: number): string {
  if (Number.isNaN(value)) return "-";
  if (line.part?.form.kind === "bool") return value ? "true" : "false";
  return value_text(value, line.part?.form.enumerators);
}

function Legend({ props, cursor }: { props: Props; cursor: number | null }) {
  const { lines, marks, remove } = props;
  const step = cursor === null ? props.step : null;
  const now = step ? lines.map(({ name }) => step.numbers.get(name) ?? NaN) : values_at(props, cursor);
  const at = marks.map((mark) => values_at(props, mark));
  return (
    <table class="legend">
      {(marks.length > 0 || props.step) && (
        <thead><tr><th scope="col">Variable</th><th scope="col">{step ? step.name : cursor === null ? "newest" : "at cursor"}</th><th scope="col">Unit</th>
          {marks.map((_, i) => <th key={i} scope="col">{MARKS[i]}</th>)}
          {marks.length === 2 && <th scope="col">B - A, in {short(marks[1] - marks[0])} s</th>}<th /></tr></thead>)}
      <tbody>
        {lines.map((line, i) => (
          <tr key={line.name}>
            <th scope="row"><span class={`swatch c${i % COLOURS} ${i % 2 ? "dashed" : ""}`} aria-hidden="true" /><Name text={line.name} /></th>
            <td class="number">{shown_value(line, now[i])}</td>
            <td class="unit">{line.part?.unit ?? ""}</td>
            {at.map((values, m) => <td key={m} class="number">{shown_value(line, values[i])}</td>)}
            {at.length === 2 && <td class="number">{Number.isNaN(at[1][i] - at[0][i]) ? "-" : value_text(at[1][i] - at[0][i])}</td>}
            <td><button type="button" class="small" onClick={() => remove(line.name)} aria-label={`Remove ${line.name}`}>{"\u00d7"}</button></td>
          </tr>))}
      </tbody>
    </table>);
}

export function Chart(props: Props) {
  const box = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const latest = useRef(props);
  latest.current = props;
  const [cursor, set_cursor] = useState<number | null>(null);
  const [over, set_over] = useState(false);
  const colours = useStore(colours_changed);
  const key = props.lines.map(({ name, part }) => `${name} ${part?.form.kind}`).join();
  useEffect(() => {
    const element = box.current!;
    const size = () => ({ width: element.clientWidth, height: Math.max(180, Math.round(element.clientHeight)) });
    const chart = new uPlot(options(() => latest.current, size(), set_cursor), data_of(latest.current), element);
    plot.current = chart;
    latest.current.set_plot(chart);
    const watch = new ResizeObserver(() => chart.setSize(size()));
    watch.observe(element);
    let down = 0;
    chart.over.addEventListener("pointerdown", (event) => { down = event.clientX; });
    chart.over.addEventListener("click", (event) => {
      if (Math.abs(event.clientX - down) < 4) latest.current.mark(chart.posToVal(event.offsetX, "x"));
    });
    chart.over.addEventListener("dblclick", () => latest.current.live());
    return () => {
      watch.disconnect();
      latest.current.set_plot(null);
      chart.destroy();
    };
  }, [key, colours]);
  useEffect(() => plot.current?.setData(data_of(latest.current)), [props.drawn, props.marks, props.step]);
  const drawable = props.lines.filter(({ part }) => part && !is_number(part));
  return (
    <section class={`panel chart ${over ? "over" : ""}`} aria-label={`Chart ${props.index + 1}`}
      onDragOver={(event) => { event.preventDefault(); set_over(true); }} onDragLeave={() => set_over(false)}
      onDrop={(event) => { event.preventDefault(); set_over(false); props.drop(event.dataTransfer?.getData("text/plain") ?? ""); }}>
      <div class="plot" ref={box} role="img" aria-label={`Values over time of ${props.lines.map(({ name }) => name).join(", ")}; the table below lists them`} />
      <div class="scroll" tabIndex={0} role="region" aria-label={`Values of chart ${props.index + 1}`}><Legend props={props} cursor={cursor} /></div>
      {drawable.length > 0 && <p class="warn">{drawable.map(({ name }) => name).join(", ")} is not a number: select a part of it.</p>}
    </section>);
}
