// SPDX-License-Identifier: Apache-2.0
// Set and force a value; of a struct or an array what is written of it, as text. The page checks the range to spare a way; the server decides.

import { useEffect, useRef, useState } from "preact/hooks";
import { board_path, post, words } from "../../api/http";
import { keep } from "../../shell/leases";
import { plant } from "../../shell/plant";
import { value_text } from "../../ui/format";
import { has_parts, type Part } from "../../ui/paths";

const HOW_LONG: [string, number][] = [["for 10 s", 10e9], ["for 1 min", 60e9], ["for 10 min", 600e9], ["until released", 0], ["while this page is open", -1]];

export function range_text({ range, unit }: Part): string {
  if (!range || (range.min === null && range.max === null)) return "";
  const with_unit = (value: number) => `${value}${unit ? ` ${unit}` : ""}`;
  if (range.min === null) return `at most ${with_unit(range.max!)}`;
  if (range.max === null) return `at least ${with_unit(range.min)}`;
  return `${range.min} to ${with_unit(range.max)}`;
}

// What is wrong with `text` as a value of `part`; empty: nothing the page can see.
export function wrong_with(part: Part, text: string): string {
  const { kind } = part.form;
  if (kind === "text" || kind === "char") return "";
  if (has_parts(part)) return text.trim() === "" ? "Write a value first." : "";
  if (text.trim() === "") return "Write a value first.";
  if (kind === "bool" || kind === "enum") return "";
  const value = Number(text);
  if (Number.isNaN(value)) return `'${text}' is no number.`;
  if (!kind.startsWith("f") && !Number.isInteger(value)) return "Only whole numbers fit here.";
  const { min, max } = part.range ?? { min: null, max: null };
  if ((min !== null && value < min) || (max !== null && value > max)) return `Out of its range: ${range_text(part)}.`;
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
  const here = plant.get().boards?.find((one) => one.board === board)?.here ?? true;
  const ways = here ? HOW_LONG : HOW_LONG.filter(([, ns]) => ns >= 0);  // leases are for boards of this host
  const [text, put] = useState("");
  const touched = useRef(false);  // not a state: the effect must know at once
  const [how_long, choose] = useState(0);
  const [reason, give] = useState("");
  const [said, say] = useState<{ text: string; bad: boolean }>({ text: "", bad: false });
  // The present value is what the field begins with; when it comes late, it must not replace what was written meanwhile.
  useEffect(() => {
    if (!touched.current) put(value === undefined || has_parts(part) ? "" : value_text(value, part.form.enumerators));
  }, [value === undefined]);
  const write = (what: string) => {
    touched.current = true;
    put(what);
  };
  const order = async (path: string, body: object, what: string) => {
    try {
      const { lease, lease_ns } = await post<{ lease?: string; lease_ns?: number }>(board_path(board, path), reason ? { ...body, reason } : body);
      if (lease && lease_ns) keep({ board, lease, names: [part.name] }, lease_ns);
      say({ text: what, bad: false });
    } catch (error) {
      say({ text: words(error), bad: true });
    }
    done();
  };
  const with_value = (path: string, more: object, what: string) => {
    const wrong = wrong_with(part, text);
    if (wrong) return say({ text: wrong, bad: true });
    return void order(path, { values: { [part.name]: value_of(part, text) }, ...more }, what);
  };
  const for_ns = HOW_LONG[how_long][1];
  const until = for_ns > 0 ? { for_ns } : for_ns < 0 ? { lease: true } : {};
  return (
    <form class="write" onSubmit={(event) => { event.preventDefault(); with_value("/set", {}, `Set to ${text}.`); }}>
      <div class="bar">
        <Input part={part} text={text} write={write} /><span>{part.unit}</span>
        <button type="submit" class="main">Set</button>
      </div>
      <div class="bar">
        <button type="button" onClick={() => with_value("/force", until, `Forced to ${text} ${HOW_LONG[how_long][0]}.`)}>Force</button>
        <select aria-label="How long to force" value={how_long} onChange={(event) => choose(Number(event.currentTarget.value))}>
          {ways.map(([name], i) => <option key={name} value={i}>{name}</option>)}
        </select>
        {forced && <button type="button" onClick={() => order("/release", { names: [part.name] }, "Released.")}>Release</button>}
      </div>
      <label class="reason">Reason, for the audit log <input value={reason} onInput={(event) => give(event.currentTarget.value)} /></label>
      <p role="status" class={said.bad ? "bad" : "good"}>{said.text}</p>
    </form>);
}
