// SPDX-License-Identifier: Apache-2.0
// Charts of every tick around a trigger, beside the strip charts of plots.tsx.

import { useEffect, useRef, useState } from "preact/hooks";
import type uPlot from "uplot";
import type { BoardSummary } from "../../api/types";
import { change_query } from "../../ui/address";
import { plural, span } from "../../ui/format";
import type { Part } from "../../ui/paths";
import { Picture, follow } from "./capture";
import { Chart, type Line, type Shown } from "./chart";
import { save_png, save_text } from "./export";
import type { Wish } from "./layout";

interface Props {
  board: BoardSummary;
  wish: Wish;
  charts: string[][];
  drawable: string[];
  line: (name: string) => Line;
  remove: (index: number, name: string) => void;
  drop: (name: string, index: number) => void;
}

function Ticks({ label, name, value }: { label: string; name: string; value: number }) {
  return (
    <label class="choice">{label}{" "}
      <input type="number" class="ticks" min={0} max={9999} value={value} onChange={(event) => change_query({ [name]: event.currentTarget.value })} /></label>);
}

// "error" of "error = target - actual", as the server names the channel.
function channel_of(expression: string): string {
  return (/^([^=<>!]+)=(?!=)/.exec(expression)?.[1] ?? expression).trim();
}

function lines_of(picture: Picture | null, expression: string): Line[] {
  const lines = picture?.capture.lines.filter(({ channel }) => channel === channel_of(expression)) ?? [];
  return lines.map(({ name, unit }) => ({ name, part: { unit, form: { kind: "f64", size: 8 } } as Part }));
}

const EMPTY = { size: 0, times: new Float64Array(0), column: () => undefined, index_at: () => 0 };

// What a picture shows, in words.
function said({ capture }: Picture): string {
  const { trigger, trigger_row, first_tick, rows, period_ns, lost_runs } = capture;
  const what = trigger_row === null ? `${plural(rows, "tick")} from tick ${first_tick} on`
    : `${trigger} at tick ${first_tick + trigger_row}: ${trigger_row} ticks before, ${rows - trigger_row - 1} after`;
  return `${what}, every ${span(period_ns)}.${lost_runs ? ` ${plural(lost_runs, "run")} missing: the server was too slow.` : ""}`;
}

export function Triggered({ board, wish, charts, drawable, line, remove, drop }: Props) {
  const [picture, show] = useState<Picture | null>(null);
  const [waiting, wait] = useState("");
  const [refused, refuse] = useState("");
  const [round, again] = useState(0);  // one more: ask anew
  const [held, hold] = useState(false);
  const [zoomed, zoom] = useState<Shown | null>(null);
  const [marks, set_marks] = useState<number[]>([]);
  const [drawn, draw] = useState(0);
  useEffect(() => draw((n) => n + 1), [picture, zoomed]);
  const wanted = [...drawable, ...wish.expressions];
  const plots = useRef(new Map<number, uPlot>());
  const key = [board.board, board.layout, wish.mode, wish.trigger, wish.pre, wish.post, wanted.join("\n")].join(" ");
  useEffect(() => {
    if (held || wanted.length === 0) return;
    refuse("");
    wait(wish.trigger ? `Waiting for: ${wish.trigger}` : "Taking a picture ...");
    return follow(board.board, wanted, wish, {
      picture: (next) => { show(next); wait(""); refuse(""); },
      waiting: wait,
      refused: (why) => { refuse(why); wait(""); },
    });
  }, [key, round, held]);

  const samples = picture ?? EMPTY;
  const shown = (): Shown => zoomed ?? (picture ? { from: samples.times[0], to: samples.times[samples.size - 1] } : { from: 0, to: 1 });
  return (
    <>
      <form class="bar" onSubmit={(event) => { event.preventDefault(); hold(false); again(round + 1); }}>
        <label class="choice trigger">Trigger{" "}
          <input type="text" placeholder="NAME rises, or speed > 100" value={wish.trigger} spellcheck={false} autocomplete="off"
            onChange={(event) => change_query({ t: event.currentTarget.value.trim() })} /></label>
        <Ticks label="Before" name="pre" value={wish.pre} />
        <Ticks label="After" name="post" value={wish.post} />
        {wish.mode === "single" ? <button type="submit">Again</button>
          : <button type="button" aria-pressed={held} onClick={() => hold(!held)}>{held ? "Go on" : "Hold"}</button>}
        {zoomed && <button type="button" onClick={() => zoom(null)}>All</button>}
        <button type="button" disabled={!picture} onClick={() => picture && save_text(picture.csv([...drawable, ...wish.expressions.flatMap((one) => lines_of(picture, one).map(({ name }) => name))]))}>CSV</button>
        <button type="button" disabled={!picture} onClick={() => save_png([...plots.current.values()])}>PNG</button>
        {marks.length > 0 && <button type="button" onClick={() => set_marks([])}>Clear marks</button>}
      </form>
      <form class="bar" onSubmit={(event) => {
        event.preventDefault();
        const field = event.currentTarget.elements.namedItem("expression") as HTMLInputElement;
        if (field.value.trim()) change_query({ e: [...wish.expressions, field.value.trim()] });
        field.value = "";
      }}>
        <label class="choice trigger">Expression{" "}
          <input type="text" name="expression" placeholder="error = abs(target - actual)" spellcheck={false} autocomplete="off" /></label>
        <button type="submit">Add</button>
        {wish.expressions.map((one) => (
          <button key={one} type="button" aria-label={`Remove ${one}`} onClick={() => change_query({ e: wish.expressions.filter((other) => other !== one) })}>{one} {"\u00d7"}</button>))}
      </form>
      <p class="quiet" role="status">{[picture && said(picture), held ? "Held." : waiting].filter(Boolean).join(" ")}</p>
      {refused && <p class="bad">{refused}</p>}
      {[...charts.map((chart) => chart.map(line)), ...wish.expressions.map((one) => lines_of(picture, one))].map((lines, index) => (
        <Chart key={index} index={index} lines={lines} recorder={samples} relative shown={shown} drawn={drawn}
          marks={marks} zoom={zoom} live={() => { zoom(null); set_marks([]); }}
          mark={(at) => set_marks(marks.length === 2 ? [] : [...marks, at].sort((a, b) => a - b))}
          remove={(name) => (index < charts.length ? remove(index, name) : change_query({ e: wish.expressions.filter((_, i) => i !== index - charts.length) }))}
          drop={(name) => drop(name, Math.min(index, charts.length))}
          made={(plot) => { if (plot) plots.current.set(index, plot); else plots.current.delete(index); }} />))}
    </>);
}
