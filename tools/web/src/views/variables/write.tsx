// SPDX-License-Identifier: Apache-2.0
// The form that sets and forces a value; parts of a struct or an array are written as text. The page checks the range to spare
// a request; the server decides.

import { useEffect, useRef, useState } from "preact/hooks";
import { board_path, message_of, post } from "../../api/http";
import { add_lease } from "../../shell/leases";
import { useMay } from "../../shell/plant";
import { value_text } from "../../ui/format";
import { has_parts, type Part } from "../../ui/paths";

const DURATIONS: [string, number][] = [["for 10 s", 10e9], ["for 1 min", 60e9], ["for 10 min", 600e9], ["until released", 0], ["while this page is open", -1]];

export function range_text({ range, unit }: Part): string {
  if (!range || (range.min === null && range.max === null)) return "";
  const with_unit = (value: number) => `${value}${unit ? ` ${unit}` : ""}`;
  if (range.min === null) return `at most ${with_unit(range.max!)}`;
  if (range.max === null) return `at least ${with_unit(range.min)}`;
  return `${range.min} to ${with_unit(range.max)}`;
}

// Why `text` is not a value of `part`; empty: the page finds nothing wrong.
function problem_with(part: Part, text: string): string {
  const { kind } = part.form;
  if (kind === "text" || kind === "char") return "";
  if (has_parts(part)) return text.trim() === "" ? "Enter a value first." : "";
  if (text.trim() === "") return "Enter a value first.";
  if (kind === "bool" || kind === "enum") return "";
  const value = Number(text);
  if (Number.isNaN(value)) return `'${text}' is not a number.`;
  if (!kind.startsWith("f") && !Number.isInteger(value)) return "Only whole numbers are allowed.";
  const { min, max } = part.range ?? { min: null, max: null };
  if ((min !== null && value < min) || (max !== null && value > max)) return `Outside of the range: ${range_text(part)}.`;
  return "";
}

function value_of(part: Part, text: string): unknown {
  if (has_parts(part)) return text;
  if (part.form.kind === "bool") return text === "true";
  if (["text", "char", "enum"].includes(part.form.kind)) return text;
  return Number(text);
}

function Input({ part, text, write }: { part: Part; text: string; write: (text: string) => void }) {
  const choices = has_parts(part) ? [] : part.form.kind === "bool" ? ["false", "true"] : Object.keys(part.form.enumerators ?? {});
  const label = `New value of ${part.name}`;
  if (choices.length > 0) {
    return (
      <select aria-label={label} value={text} onChange={(event) => write(event.currentTarget.value)}>
        {!choices.includes(text) && <option value={text}>{text || "choose"}</option>}
        {choices.map((one) => <option key={one} value={one}>{one}</option>)}
      </select>);
  }
  if (has_parts(part)) {
    return <textarea aria-label={label} value={text} rows={4} spellcheck={false} placeholder={part.form.dims?.length ? "[1, 2, 3]" : "{x: 1}"}
      onInput={(event) => write(event.currentTarget.value)} />;
  }
  return <input aria-label={label} value={text} inputMode={part.form.kind === "text" ? "text" : "decimal"} size={14}
    onInput={(event) => write(event.currentTarget.value)} />;
}

interface Props {
  board: string;
  part: Part;
  value: unknown;
  forced: boolean;
  done: () => void;
}

export function Write({ board, part, value, forced, done }: Props) {
  const may_force = useMay("tune");
  const [text, set_text] = useState("");
  const touched = useRef(false);  // not a state: the effect needs it immediately
  const [duration, set_duration] = useState(0);
  const [reason, set_reason] = useState("");
  const [result, set_result] = useState<{ text: string; bad: boolean }>({ text: "", bad: false });
  // The field begins with the current value. If that arrives late, it must not replace what the user entered meanwhile.
  useEffect(() => {
    if (!touched.current) set_text(value === undefined || has_parts(part) ? "" : value_text(value, part.form.enumerators));
  }, [value === undefined]);
  const write = (next: string) => {
    touched.current = true;
    set_text(next);
  };
  const send = async (path: string, body: object, success: string) => {
    try {
      const { lease, lease_ns } = await post<{ lease?: string; lease_ns?: number }>(board_path(board, path), reason ? { ...body, reason } : body);
      if (lease && lease_ns) add_lease({ board, lease, names: [part.name] }, lease_ns);
      set_result({ text: success, bad: false });
    } catch (error) {
      set_result({ text: message_of(error), bad: true });
    }
    done();
  };
  const send_value = (path: string, more: object, success: string) => {
    const problem = problem_with(part, text);
    if (problem) return set_result({ text: problem, bad: true });
    return void send(path, { values: { [part.name]: value_of(part, text) }, ...more }, success);
  };
  const for_ns = DURATIONS[duration][1];
  const until = for_ns > 0 ? { for_ns } : for_ns < 0 ? { lease: true } : {};
  return (
    <form class="write" onSubmit={(event) => { event.preventDefault(); send_value("/set", {}, `Set to ${text}.`); }}>
      <div class="bar">
        <Input part={part} text={text} write={write} /><span>{part.unit}</span>
        <button type="submit" class="main">Set</button>
      </div>
      {may_force && <div class="bar">
        <button type="button" onClick={() => send_value("/force", until, `Forced to ${text} ${DURATIONS[duration][0]}.`)}>Force</button>
        <select aria-label="How long to force" value={duration} onChange={(event) => set_duration(Number(event.currentTarget.value))}>
          {DURATIONS.map(([name], i) => <option key={name} value={i}>{name}</option>)}
        </select>
        {forced && <button type="button" onClick={() => send("/release", { names: [part.name] }, "Released.")}>Release</button>}
      </div>}
      <label class="reason">Reason, for the audit log <input value={reason} onInput={(event) => set_reason(event.currentTarget.value)} /></label>
      <p role="status" class={result.bad ? "bad" : "good"}>{result.text}</p>
    </form>);
}
