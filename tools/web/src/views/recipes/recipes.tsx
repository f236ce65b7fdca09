// SPDX-License-Identifier: Apache-2.0
// Recipes of a board: sets of parameter values that are saved, compared with the current values, and loaded in one tick.

import { useState } from "preact/hooks";
import { board_path, get, message_of, post } from "../../api/http";
import type { Recipe, RecipeValues } from "../../api/types";
import { NoBoard } from "../../shell/no_board";
import { how_to_write, plant, useBoard, useMay } from "../../shell/plant";
import { change_query, place } from "../../ui/address";
import { clock, plural, value_text } from "../../ui/format";
import { DataTable, Panel, Waiting } from "../../ui/parts";
import { useRequest, useStore } from "../../ui/store";

const PURPOSE = "A recipe is a named set of parameter values, for example those of one product. It can be compared with the current values and loaded in one tick.";
const EVERY_MS = 5000;
const COMPARE_MS = 2000;

type Act = (name: string, act: "save" | "load" | "remove", body: object) => Promise<void>;

function Values({ board, name }: { board: string; name: string }) {
  const [all, set_all] = useState(false);
  const { value, error } = useRequest(`${board} ${name}`, COMPARE_MS, () => get<RecipeValues>(board_path(board, `/recipes/${name}`)));
  if (error) return <p class="bad">{error}</p>;
  if (!value) return <Waiting />;
  const differ = value.values.filter(({ same }) => !same);
  const shown = all ? value.values : differ;
  return (
    <>
      <div class="bar">
        <span class={differ.length > 0 ? "warn" : "good"}>
          {differ.length > 0 ? `${plural(differ.length, "value differs", "values differ")} from the current ${differ.length === 1 ? "value" : "values"}.` : "The recipe matches the current values."}</span>
        <button type="button" aria-pressed={all} onClick={() => set_all(!all)}>Show all {value.values.length} values</button>
      </div>
      {shown.length > 0 && (
        <DataTable label={`Values of ${name}`}>
            <thead><tr><th scope="col">Name</th><th scope="col" class="number">Recipe</th><th scope="col" class="number">Current</th></tr></thead>
            <tbody>
              {shown.map(({ name: part, recipe, now, same }) => (
                <tr key={part}><th scope="row">{part}</th><td class="number">{value_text(recipe)}</td>
                  <td class={`number ${same ? "" : "warn"}`}>{now === null ? "missing" : value_text(now)}</td></tr>))}
            </tbody>
        </DataTable>)}
    </>);
}

function Save({ act }: { act: Act }) {
  const [name, set_name] = useState("");
  const [patterns, set_patterns] = useState("");
  const [comment, set_comment] = useState("");
  const save = (event: Event) => {
    event.preventDefault();
    const names = patterns.split(/\s+/).filter(Boolean);
    void act(name, "save", { ...(names.length > 0 ? { names } : {}), ...(comment ? { comment } : {}) });
  };
  return (
    <form class="bar" onSubmit={save}>
      <label>Name <input required pattern="[A-Za-z0-9_\-]{1,60}" value={name} onInput={(event) => set_name(event.currentTarget.value)} /></label>
      <label>Variable names <input placeholder="all parameters" value={patterns} onInput={(event) => set_patterns(event.currentTarget.value)} /></label>
      <label>Comment <input value={comment} onInput={(event) => set_comment(event.currentTarget.value)} /></label>
      <button type="submit" class="main">Save current values</button>
    </form>);
}

export function Recipes() {
  const { status } = useStore(plant);
  const may_load = useMay("operate");
  const may_save = useMay("tune");
  const chosen = useStore(place).query.get("r") ?? "";
  const board = useBoard()?.board ?? "";
  const [result, set_result] = useState<{ text: string; bad: boolean }>({ text: "", bad: false });
  const { value, error, refresh } = useRequest(board, EVERY_MS, () => get<{ recipes: Recipe[] }>(board_path(board, "/recipes")));
  if (!board) return <NoBoard purpose={PURPOSE} />;
  const act: Act = async (name, verb, body) => {
    try {
      const done = await post<{ values?: number; tick?: number | null }>(board_path(board, `/recipes/${encodeURIComponent(name)}/${verb}`), body);
      const when = done.tick === null ? ", for the next start of the node" : done.tick === undefined ? "" : ` in tick ${done.tick}`;
      set_result({ text: verb === "remove" ? `${name} removed.` : `${name}: ${plural(done.values ?? 0, "value")} ${verb === "save" ? "saved" : `loaded${when}`}.`, bad: false });
    } catch (problem) {
      set_result({ text: message_of(problem), bad: true });
    }
    refresh();
  };
  const recipes = value?.recipes ?? [];
  return (
    <>
      <Panel title="Recipes">
        {error && <p class="bad">{error}</p>}
        {!value && !error && <Waiting />}
        {may_save && <Save act={act} />}
        <p role="status" class={result.bad ? "bad" : "good"}>{result.text}</p>
        {value && recipes.length === 0 && <p class="quiet">{PURPOSE} This board has no recipes yet.{" "}
          {status && !may_save && `To save one, ${how_to_write(status)}.`}</p>}
        {recipes.length > 0 && (
          <DataTable label="Recipes">
              <thead><tr><th scope="col">Recipe</th><th scope="col" class="number">Values</th><th scope="col">Saved</th><th scope="col">Comment</th>
                {may_load && <th scope="col">Actions</th>}</tr></thead>
              <tbody>
                {recipes.map(({ recipe, values, saved_wall_ns, who, comment }) => (
                  <tr key={recipe}>
                    <th scope="row"><button type="button" aria-pressed={recipe === chosen} onClick={() => change_query({ r: recipe })}>{recipe}</button></th>
                    <td class="number">{values}</td><td>{clock(saved_wall_ns)}{who && ` by ${who}`}</td><td class="comment">{comment || "-"}</td>
                    {may_load && <td><span class="actions">
                      <button type="button" class="main" aria-label={`Load ${recipe}`} onClick={() => act(recipe, "load", {})}>load</button>
                      {may_save && <button type="button" aria-label={`Remove ${recipe}`} onClick={() => act(recipe, "remove", {})}>remove</button>}
                    </span></td>}
                  </tr>))}
              </tbody>
          </DataTable>)}
      </Panel>
      {recipes.some(({ recipe }) => recipe === chosen) && <Panel title={`${chosen} compared with the current values`}><Values board={board} name={chosen} /></Panel>}
    </>);
}
