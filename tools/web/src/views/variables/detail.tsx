// SPDX-License-Identifier: Apache-2.0
// Everything that is known of the chosen variable or part, and what may be done with it.

import { board_path, get, words } from "../../api/http";
import type { Variable } from "../../api/types";
import { plant } from "../../shell/plant";
import { address } from "../../ui/address";
import { span, value_text } from "../../ui/format";
import { Figure } from "../../ui/parts";
import { has_parts, numbers_of, value_in, type Part } from "../../ui/paths";
import { useAsked, useStore } from "../../ui/store";
import type { Live } from "./live";
import { range_text, Write } from "./write";

const EVERY_MS = 1000;
const MOST_PLOTTED = 12;

function people(modules: string[] | null, nobody: string): string {
  if (modules === null) return "unknown: the module files could not be read";
  return modules.length > 0 ? modules.join(", ") : nobody;
}

interface Props {
  board: string;
  part: Part;
  live: Live;
  close: () => void;
  changed: () => void;
}

export function Detail({ board, part, live, close, changed }: Props) {
  const { status } = useStore(plant);
  const { variable } = part;
  const asked = useAsked(`${board} ${variable.name}`, EVERY_MS,
    () => get<Variable>(board_path(board, `/variables/${encodeURIComponent(variable.name)}`)), words);
  const fresh = asked.value ?? variable;
  const value = value_in(live.values.get(variable.name), variable.name, part.name);
  const forced = fresh.forced.filter((one) => one === variable.name || one.startsWith(part.name));
  const plotted = numbers_of(part, MOST_PLOTTED);
  const range = range_text(part);
  return (
    <aside class="panel detail" aria-label={`About ${part.name}`}>
      <h2>{part.name}<button type="button" class="close" aria-label="Close" onClick={close}>{"\u00d7"}</button></h2>
      {part.description && <p>{part.description}</p>}
      {!has_parts(part) && <p class="big">{value_text(value, part.form.enumerators)} <span class="quiet">{part.unit}</span></p>}
      {forced.length > 0 && <p class="warn"><strong>Forced:</strong> {forced.join(", ")}. What modules write there is not seen.</p>}
      {fresh.quality !== "good" && <p class="bad">This value is {fresh.quality}.</p>}
      {asked.error && <p class="bad">{asked.error}</p>}
      <dl class="facts">
        <Figure name="Type" value={part === null ? "" : part.name === variable.name ? variable.type : part.form.name ?? part.form.kind} />
        <Figure name="Unit" value={part.unit || "none"} />
        {range && <Figure name="Range" value={range} />}
        <Figure name="Age" value={fresh.age_ns === null ? "this board's own" : span(fresh.age_ns)} />
        <Figure name="Written by" value={people(fresh.writers, "no module")} />
        <Figure name="Read by" value={people(fresh.readers, "no module")} />
        <Figure name="After a power loss" value={variable.retain ? "kept" : "starts anew"} />
        <Figure name="Declared in" value={variable.source} />
      </dl>
      {plotted.length > 0 && plotted.length <= MOST_PLOTTED && (
        <p><a href={address("plots", { board, c: plotted.join(",") })}>{plotted.length === 1 ? "Plot it" : `Plot its ${plotted.length} numbers`}</a></p>)}
      {status?.may_write &&
        <Write key={`${board} ${part.name}`} board={board} part={part} value={value} forced={forced.length > 0} done={() => { asked.again(); changed(); }} />}
      {status && !status.may_write && <p class="quiet">This page may only look. To write: indurop serve --write</p>}
    </aside>);
}
