// SPDX-License-Identifier: Apache-2.0
// Charts of every tick around a trigger.

import { useEffect, useRef, useState } from "preact/hooks";
import type uPlot from "uplot";
import type { BoardSummary } from "../../api/types";
import { change_query } from "../../ui/address";
import { plural, span } from "../../ui/format";
import { useEntry } from "../../ui/parts";
import type { Part } from "../../ui/paths";
import { capture_until_ended, CapturedSamples } from "./capture";
import { Chart, type Line, type Shown } from "./chart";
import { save_png, save_text } from "./export";
import type { Scope } from "./layout";

interface Props {
  board: BoardSummary;
  scope: Scope;
  charts: string[][];
  drawable: string[];
  line: (name: string) => Line;
  remove: (index: number, name: string) => void;
  drop: (name: string, index: number) => void;
}

function Ticks({ label, name, value }: { label: string; name: string; value: number }) {
  const entry = useEntry(value, (text) => change_query({ [name]: text }));
  return (
    <label class="choice">{label}{" "}
      <input type="number" class="ticks" min={0} max={9999} {...entry} /></label>);
}

// "error" of "error = target - actual", as the server names the channel.
function channel_of(expression: string): string {
  return (/^([^=<>!]+)=(?!=)/.exec(expression)?.[1] ?? expression).trim();
}

function lines_of(captured: CapturedSamples | null, expression: string): Line[] {
  const lines = captured?.capture.lines.filter(({ channel }) => channel === channel_of(expression)) ?? [];
  return lines.map(({ name, unit }) => ({ name, part: { unit, form: { kind: "f64", size: 8 } } as Part }));
}

const EMPTY = { size: 0, times: new Float64Array(0), column: () => undefined, index_at: () => 0 };

// What a capture shows, as text.
function description_of({ capture }: CapturedSamples): string {
  const { trigger, trigger_row, first_tick, rows, period_ns, lost_runs } = capture;
  const what = trigger_row === null ? `${plural(rows, "tick")} from tick ${first_tick}`
    : `${trigger} at tick ${first_tick + trigger_row}: ${trigger_row} ticks before, ${rows - trigger_row - 1} after`;
  return `${what}, every ${span(period_ns)}.${lost_runs ? ` ${plural(lost_runs, "run")} missing: the server was too slow.` : ""}`;
}

export function Triggered({ board, scope, charts, drawable, line, remove, drop }: Props) {
  const [captured, set_captured] = useState<CapturedSamples | null>(null);
  const [waiting, set_waiting] = useState("");
  const [problem, set_problem] = useState("");
  const [round, set_round] = useState(0);  // counts requests for another capture
  const [held, set_held] = useState(false);
  const [zoomed, set_zoomed] = useState<Shown | null>(null);
  const [marks, set_marks] = useState<number[]>([]);
  const [drawn, set_drawn] = useState(0);
  useEffect(() => set_drawn((n) => n + 1), [captured, zoomed]);
  const trigger = useEntry(scope.trigger, (text) => change_query({ t: text.trim() }));
  const wanted = [...drawable, ...scope.expressions];
  const plots = useRef(new Map<number, uPlot>());
  const key = [board.board, board.layout, scope.mode, scope.trigger, scope.pre, scope.post, wanted.join("\n")].join(" ");
  useEffect(() => {
    if (held || wanted.length === 0) return;
    set_problem("");
    set_waiting(scope.trigger ? `Waiting for: ${scope.trigger}` : "Capturing ...");
    return capture_until_ended(board.board, wanted, scope, {
      captured: (next) => { set_captured(next); set_waiting(""); set_problem(""); },
      waiting: set_waiting,
      rejected: (why) => { set_problem(why); set_waiting(""); },
    });
  }, [key, round, held]);

  const samples = captured ?? EMPTY;
  const shown = (): Shown => zoomed ?? (captured ? { from: samples.times[0], to: samples.times[samples.size - 1] } : { from: 0, to: 1 });
  return (
    <>
      <form class="bar" onSubmit={(event) => { event.preventDefault(); set_held(false); set_round(round + 1); }}>
        <label class="choice trigger">Trigger{" "}
          <input type="text" placeholder="NAME rises, or speed > 100" spellcheck={false} autocomplete="off" {...trigger} /></label>
        <Ticks label="Before" name="pre" value={scope.pre} />
        <Ticks label="After" name="post" value={scope.post} />
        {scope.mode === "single" ? <button type="submit">Capture again</button>
          : <button type="button" aria-pressed={held} onClick={() => set_held(!held)}>{held ? "Resume" : "Hold"}</button>}
        {zoomed && <button type="button" onClick={() => set_zoomed(null)}>All</button>}
        <button type="button" disabled={!captured} onClick={() => captured && save_text(captured.csv([...drawable, ...scope.expressions.flatMap((one) => lines_of(captured, one).map(({ name }) => name))]))}>CSV</button>
        <button type="button" disabled={!captured} onClick={() => save_png([...plots.current.values()])}>PNG</button>
        {marks.length > 0 && <button type="button" onClick={() => set_marks([])}>Clear marks</button>}
      </form>
      <form class="bar" onSubmit={(event) => {
        event.preventDefault();
        const field = event.currentTarget.elements.namedItem("expression") as HTMLInputElement;
        if (field.value.trim()) change_query({ e: [...scope.expressions, field.value.trim()] });
        field.value = "";
      }}>
        <label class="choice trigger">Expression{" "}
          <input type="text" name="expression" placeholder="error = abs(target - actual)" spellcheck={false} autocomplete="off" /></label>
        <button type="submit">Add</button>
        {scope.expressions.map((one) => (
          <button key={one} type="button" aria-label={`Remove ${one}`} onClick={() => change_query({ e: scope.expressions.filter((other) => other !== one) })}>{one} {"\u00d7"}</button>))}
      </form>
      <p class="quiet" role="status">{[captured && description_of(captured), held ? "Held." : waiting].filter(Boolean).join(" ")}</p>
      {problem && <p class="bad">{problem}</p>}
      {[...charts.map((chart) => chart.map(line)), ...scope.expressions.map((one) => lines_of(captured, one))].map((lines, index) => (
        <Chart key={index} index={index} lines={lines} recorder={samples} relative shown={shown} drawn={drawn}
          marks={marks} zoom={set_zoomed} live={() => { set_zoomed(null); set_marks([]); }}
          mark={(at) => set_marks(marks.length === 2 ? [] : [...marks, at].sort((a, b) => a - b))}
          remove={(name) => (index < charts.length ? remove(index, name) : change_query({ e: scope.expressions.filter((_, i) => i !== index - charts.length) }))}
          drop={(name) => drop(name, Math.min(index, charts.length))}
          set_plot={(plot) => { if (plot) plots.current.set(index, plot); else plots.current.delete(index); }} />))}
    </>);
}
