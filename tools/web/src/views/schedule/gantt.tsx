// SPDX-License-Identifier: Apache-2.0
// Bars over time, a lane per module. The tables below have the same data for screen readers.

import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { letter_px } from "../../shell/theme";
import { span } from "../../ui/format";
import type { Bar, Lane } from "./lanes";

// At a letter size of 16 pixels; a wall screen has larger letters.
const LANE_PX = 34;
const BAR_PX = 20;
const AXIS_PX = 26;
const LABEL_PX = 90;  // space that a time needs on the axis
const THINNEST_PX = 2;
const PARTS = [10000, 5000, 4000, 2000, 1000, 500, 400, 200, 100, 50, 40, 20, 10, 8, 5, 4, 2];  // of a basic period

interface Props {
  lanes: Lane[];
  from_ns: number;
  to_ns: number;
  epoch_ns: number;
  basic_ns: number;
  macro_ns: number;
  zoom: number;
  chosen: number | null;
  choose: (bar: Bar) => void;
}

interface GridProps extends Props {
  x: (ns: number) => number;
  height: number;
  width: number;
  scale: number;
}

function Grid({ from_ns, to_ns, epoch_ns, basic_ns, macro_ns, x, height, width, scale }: GridProps) {
  const wanted = Math.max(1, Math.floor(width / LABEL_PX / scale));
  // At most as many lines as there is space for: one per basic period, or per several.
  const every = basic_ns * Math.max(1, Math.ceil((to_ns - from_ns) / basic_ns / wanted));
  const fine = every > basic_ns ? every : nice_step((to_ns - from_ns) / wanted, basic_ns);
  const lines = [];
  for (let at = Math.ceil((from_ns - epoch_ns) / fine) * fine + epoch_ns; at <= to_ns; at += fine) {
    const macro = macro_ns > 0 && Math.abs((at - epoch_ns) % macro_ns) < 1;
    lines.push(
      <g key={at}>
        <line x1={x(at)} x2={x(at)} y1={(AXIS_PX - 6) * scale} y2={height} class={macro ? "macro" : "basic"} />
        {x(at) + LABEL_PX / 2 * scale < width && <text x={x(at) + 3} y={(AXIS_PX - 10) * scale}>{span_since(at - from_ns, fine)}</text>}
      </g>);
  }
  return <g class="grid">{lines}</g>;
}

function nice_step(least: number, most: number): number {
  return PARTS.map((parts) => most / parts).find((step) => Number.isInteger(step) && step >= least) ?? most;
}

function span_since(ns: number, step: number): string {
  const rounded = Math.round(ns / step) * step;
  if (rounded === 0) return "0";
  return rounded >= 1e6 ? `${+(rounded / 1e6).toFixed(3)} ms` : span(rounded);
}

export function Gantt(props: Props) {
  const { lanes, from_ns, to_ns, zoom, chosen, choose } = props;
  const box = useRef<HTMLDivElement>(null);
  const [width_px, set_width_px] = useState(800);
  useLayoutEffect(() => {
    const watch = new ResizeObserver(() => set_width_px(box.current?.clientWidth ?? 800));
    watch.observe(box.current!);
    return () => watch.disconnect();
  }, []);
  const scale = letter_px() / 16;
  const [lane_px, bar_px, axis_px] = [LANE_PX * scale, BAR_PX * scale, AXIS_PX * scale];
  const width = Math.max(200, width_px * zoom);
  const height = axis_px + lanes.length * lane_px + 4;
  const x = (ns: number) => (ns - from_ns) / (to_ns - from_ns) * width;
  const cores = new Set(lanes.map(({ core }) => core)).size;
  return (
    <div class="gantt">
      <ul class="lane-names" style={{ paddingTop: `${axis_px}px` }}>
        {lanes.map(({ module, core }) => <li key={module} style={{ height: `${lane_px}px` }} title={module}>{module}{cores > 1 && <span class="quiet"> core {core}</span>}</li>)}
      </ul>
      <div class="scroll" ref={box} tabIndex={0} role="region" aria-label="Bars of the newest runs">
        <svg width={width} height={height} role="img" aria-label={`When ${lanes.map(({ module }) => module).join(", ")} ran; the tables below have the numbers`}>
          {lanes.map(({ module }, i) => <rect key={module} class={i % 2 ? "lane odd" : "lane"} x={0} y={axis_px + i * lane_px} width={width} height={lane_px} />)}
          <Grid {...props} x={x} width={width} height={height} scale={scale} />
          {lanes.map((lane, i) => lane.bars.filter(({ run }) => run.end_ns >= from_ns && run.release_ns <= to_ns).map((bar) => {
            const { run, late, preempted } = bar;
            const y = axis_px + i * lane_px + (lane_px - bar_px) / 2;
            return (
              <g key={run.number} class={`run ${late ? "late" : ""} ${chosen === run.number ? "chosen" : ""}`} onClick={() => choose(bar)}>
                <title>{`${lane.module}, tick ${run.tick}: ${span(run.end_ns - run.start_ns)}, ${span(run.start_ns - run.release_ns)} after its release`}</title>
                <line x1={x(run.release_ns)} x2={x(run.start_ns)} y1={y + bar_px / 2} y2={y + bar_px / 2} class="waits" />
                <rect x={x(run.start_ns)} y={y} width={Math.max(THINNEST_PX, x(run.end_ns) - x(run.start_ns))} height={bar_px} />
                {preempted.map(([from, to]) => <rect key={from} class="preempted" x={x(from)} y={y + 4} width={Math.max(1, x(to) - x(from))} height={bar_px - 8} />)}
              </g>);
          }))}
        </svg>
      </div>
    </div>);
}
