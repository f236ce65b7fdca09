// SPDX-License-Identifier: Apache-2.0
// Everything about the selected variable or part, and the form to set or force it.

import { board_path, get } from "../../api/http";
import type { Variable } from "../../api/types";
import { how_to_write, plant } from "../../shell/plant";
import { address } from "../../ui/address";
import { span, value_text } from "../../ui/format";
import { Fact } from "../../ui/parts";
import { has_parts, numbers_of, value_in, type Part } from "../../ui/paths";
import { useRequest, useStore } from "../../ui/store";
import type { Live } from "./live";
import { range_text, Write } from "./write";

const EVERY_MS = 1000;
const MAX_PLOTTED = 12;

function modules_text(modules: string[] | null): string {
  if (modules === null) return "unknown: the module files could not be read";
  return modules.length > 0 ? modules.join(", ") : "no module";
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
  const answer = useRequest(`${board} ${variable.name}`, EVERY_MS,
    () => get<Variable>(board_path(board, `/variables/${encodeURIComponent(variable.name)}`)));
  const latest = answer.value ?? variable;
  const value = value_in(live.values.get(variable.name), variable.name, part.name);
  const forced = latest.forced.filter((one) => one === variable.name || one.startsWith(part.name));
  const plotted = numbers_of(part, MAX_PLOTTED);
  const range = range_text(part);
  return (
    <aside class="panel detail" aria-label={`About ${part.name}`}>
      <h2>{part.name}<button type="button" class="close" aria-label="Close" onClick={close}>{"\u00d7"}</button></h2>
      {part.description && <p>{part.description}</p>}
      {!has_parts(part) && <p class="big">{value_text(value, part.form.enumerators)} <span class="quiet">{part.unit}</span></p>}
      {forced.length > 0 && <p class="warn"><strong>Forced:</strong> {forced.join(", ")}. Values that modules write have no effect.</p>}
      {latest.quality !== "good" && <p class="bad">This value is {latest.quality}.</p>}
      {answer.error && <p class="bad">{answer.error}</p>}
      <dl class="facts">
        <Fact name="Type" value={part === null ? "" : part.name === variable.name ? variable.type : part.form.name ?? part.form.kind} />
        <Fact name="Unit" value={part.unit || "none"} />
        {range && <Fact name="Range" value={range} />}
        <Fact name="Age" value={latest.age_ns === null ? "written on this board" : span(latest.age_ns)} />
        <Fact name="Written by" value={modules_text(latest.writers)} />
        <Fact name="Read by" value={modules_text(latest.readers)} />
        <Fact name="After a power loss" value={variable.retain ? "keeps its value" : "starts with its default"} />
        <Fact name="Declared in" value={variable.source} />
      </dl>
      {plotted.length > 0 && plotted.length <= MAX_PLOTTED && (
        <p><a href={address("plots", { board, c: plotted.join(",") })}>{plotted.length === 1 ? "Plot" : `Plot ${plotted.length} numbers`}</a></p>)}
      {status?.may_write &&
        <Write key={`${board} ${part.name}`} board={board} part={part} value={value} forced={forced.length > 0} done={() => { answer.refresh(); changed(); }} />}
      {status && !status.may_write && <p class="quiet">This page is read-only. To write, {how_to_write(status)}.</p>}
    </aside>);
}
