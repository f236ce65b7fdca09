// SPDX-License-Identifier: Apache-2.0
// Bars over time, a lane per module. Tables below say the same to who cannot see it.

import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { span } from "../../ui/format";
import type { Bar, Lane } from "./lanes";

const LANE_PX = 34;
const BAR_PX = 20;
const AXIS_PX = 26;
const LABEL_PX = 90;  // room a time needs on the axis
const THINNEST_PX = 2;

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

function Grid({ from_ns, to_ns, epoch_ns, basic_ns, macro_ns, x, height, width }: Props & { x: (ns: number) => number; height: number; width: number }) {
  const wanted = Math.max(1, Math.floor(width / LABEL_PX));
  // At most as many lines as have room: basic periods, or every so many.
  const every = basic_ns * Math.max(1, Math.ceil((to_ns - from_ns) / basic_ns / wanted));
  const fine = every > basic_ns ? every : nice_step((to_ns - from_ns) / wanted, basic_ns);
  const lines = [];
  for (let at = Math.ceil((from_ns - epoch_ns) / fine) * fine + epoch_ns; at <= to_ns; at += fine) {
    const macro = macro_ns > 0 && Math.abs((at - epoch_ns) % macro_ns) < 1;
    lines.push(
      <g key={at}>
        <line x1={x(at)} x2={x(at)} y1={AXIS_PX - 6} y2={height} class={macro ? "macro" : "basic"} />
        <text x={x(at) + 3} y={AXIS_PX - 10}>{span_since(at - from_ns, fine)}</text>
      </g>);
  }
  return <g class="grid">{lines}</g>;
}

function nice_step(least: number, most: number): number {
  for (let parts = 100; parts > 1; parts = parts > 10 ? parts - 10 : parts - 1) if (most % parts === 0 && most / parts >= least) return most / parts;
  return most;
}

function span_since(ns: number, step: number): string {
  const rounded = Math.round(ns / step) * step;
  return rounded >= 1e6 || rounded === 0 ? `${+(rounded / 1e6).toFixed(3)} ms` : span(rounded);
}

export function Gantt(props: Props) {
  const { lanes, from_ns, to_ns, zoom, chosen, choose } = props;
  const box = useRef<HTMLDivElement>(null);
  const [room, set_room] = useState(800);
  useLayoutEffect(() => {
    const watch = new ResizeObserver(() => set_room(box.current?.clientWidth ?? 800));
    watch.observe(box.current!);
    return () => watch.disconnect();
  }, []);
  const width = Math.max(200, room * zoom);
  const height = AXIS_PX + lanes.length * LANE_PX + 4;
  const x = (ns: number) => (ns - from_ns) / (to_ns - from_ns) * width;
  const cores = new Set(lanes.map(({ core }) => core)).size;
  return (
    <div class="gantt">
      <ul class="lane-names" style={{ paddingTop: `${AXIS_PX}px` }}>
        {lanes.map(({ module, core }) => <li key={module} style={{ height: `${LANE_PX}px` }} title={module}>{module}{cores > 1 && <span class="quiet"> core {core}</span>}</li>)}
      </ul>
      <div class="scroll" ref={box} tabIndex={0} role="region" aria-label="Bars of the newest runs">
        <svg width={width} height={height} role="img" aria-label={`When ${lanes.map(({ module }) => module).join(", ")} ran; the tables below have the same as numbers`}>
          {lanes.map(({ module }, i) => <rect key={module} class={i % 2 ? "lane odd" : "lane"} x={0} y={AXIS_PX + i * LANE_PX} width={width} height={LANE_PX} />)}
          <Grid {...props} x={x} width={width} height={height} />
          {lanes.map((lane, i) => lane.bars.filter(({ run }) => run.end_ns >= from_ns && run.release_ns <= to_ns).map((bar) => {
            const { run, late, preempted } = bar;
            const y = AXIS_PX + i * LANE_PX + (LANE_PX - BAR_PX) / 2;
            return (
              <g key={run.number} class={`run ${late ? "late" : ""} ${chosen === run.number ? "chosen" : ""}`} onClick={() => choose(bar)}>
                <title>{`${lane.module}, tick ${run.tick}: ${span(run.end_ns - run.start_ns)}, ${span(run.start_ns - run.release_ns)} after it was due`}</title>
                <line x1={x(run.release_ns)} x2={x(run.start_ns)} y1={y + BAR_PX / 2} y2={y + BAR_PX / 2} class="waits" />
                <rect x={x(run.start_ns)} y={y} width={Math.max(THINNEST_PX, x(run.end_ns) - x(run.start_ns))} height={BAR_PX} />
                {preempted.map(([from, to]) => <rect key={from} class="preempted" x={x(from)} y={y + 4} width={Math.max(1, x(to) - x(from))} height={BAR_PX - 8} />)}
              </g>);
          }))}
        </svg>
      </div>
    </div>);
}
