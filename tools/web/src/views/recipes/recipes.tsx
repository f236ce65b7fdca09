// SPDX-License-Identifier: Apache-2.0
// Recipes of a board: saved sets of parameters, what differs from what is now, and loading them in one tick.

import { useState } from "preact/hooks";
import { board_path, get, post, words } from "../../api/http";
import type { Recipe, RecipeValues } from "../../api/types";
import { plant, useBoard } from "../../shell/plant";
import { change_query, place } from "../../ui/address";
import { clock, plural, value_text } from "../../ui/format";
import { Figures, Panel, Waiting } from "../../ui/parts";
import { useAsked, useStore } from "../../ui/store";

const EVERY_MS = 5000;
const COMPARE_MS = 2000;

type Order = (name: string, what: "save" | "load" | "remove", body: object) => Promise<void>;

function Values({ board, name }: { board: string; name: string }) {
  const [all, show] = useState(false);
  const { value, error } = useAsked(`${board} ${name}`, COMPARE_MS, () => get<RecipeValues>(board_path(board, `/recipes/${name}`)), words);
  if (error) return <p class="bad">{error}</p>;
  if (!value) return <Waiting />;
  const differ = value.values.filter(({ same }) => !same);
  const shown = all ? value.values : differ;
  return (
    <>
      <div class="bar">
        <span class={differ.length > 0 ? "warn" : "good"}>
          {differ.length > 0 ? `${plural(differ.length, "value differs", "values differ")} from what is now.` : "All values are as they are now."}</span>
        <button type="button" aria-pressed={all} onClick={() => show(!all)}>All {value.values.length} values</button>
      </div>
      {shown.length > 0 && (
        <Figures label={`Values of ${name}`}>
            <thead><tr><th scope="col">Name</th><th scope="col" class="number">In the recipe</th><th scope="col" class="number">Now</th></tr></thead>
            <tbody>
              {shown.map(({ name: part, recipe, now, same }) => (
                <tr key={part}><th scope="row">{part}</th><td class="number">{value_text(recipe)}</td>
                  <td class={`number ${same ? "" : "warn"}`}>{now === null ? "not there" : value_text(now)}</td></tr>))}
            </tbody>
        </Figures>)}
    </>);
}

function Save({ order }: { order: Order }) {
  const [name, call] = useState("");
  const [what, choose] = useState("");
  const [comment, say] = useState("");
  const save = (event: Event) => {
    event.preventDefault();
    const names = what.split(/\s+/).filter(Boolean);
    void order(name, "save", { ...(names.length > 0 ? { names } : {}), ...(comment ? { comment } : {}) });
  };
  return (
    <form class="bar" onSubmit={save}>
      <label>Name <input required pattern="[A-Za-z0-9_\-]{1,60}" value={name} onInput={(event) => call(event.currentTarget.value)} /></label>
      <label>Which variables <input placeholder="all parameters" value={what} onInput={(event) => choose(event.currentTarget.value)} /></label>
      <label>Comment <input value={comment} onInput={(event) => say(event.currentTarget.value)} /></label>
      <button type="submit" class="main">Save what is now</button>
    </form>);
}

export function Recipes() {
  const { status } = useStore(plant);
  const chosen = useStore(place).query.get("r") ?? "";
  const board = useBoard()?.board ?? "";
  const [said, tell] = useState<{ text: string; bad: boolean }>({ text: "", bad: false });
  const { value, error, again } = useAsked(board, EVERY_MS, () => get<{ recipes: Recipe[] }>(board_path(board, "/recipes")), words);
  if (!board) return null;
  const order: Order = async (name, what, body) => {
    try {
      const done = await post<{ values?: number; tick?: number | null }>(board_path(board, `/recipes/${encodeURIComponent(name)}/${what}`), body);
      const when = done.tick === null ? ", for the next start of the node" : done.tick === undefined ? "" : ` in tick ${done.tick}`;
      tell({ text: what === "remove" ? `${name} removed.` : `${name}: ${plural(done.values ?? 0, "value")} ${what === "save" ? "saved" : `loaded${when}`}.`, bad: false });
    } catch (problem) {
      tell({ text: words(problem), bad: true });
    }
    again();
  };
  const recipes = value?.recipes ?? [];
  return (
    <>
      <Panel title="Recipes">
        {error && <p class="bad">{error}</p>}
        {!value && !error && <Waiting />}
        {status?.may_write && <Save order={order} />}
        <p role="status" class={said.bad ? "bad" : "good"}>{said.text}</p>
        {value && recipes.length === 0 && <p class="quiet">A recipe keeps parameters under a name: those of another product, or those that worked. It is compared with what is now, and loaded in one tick. There are no recipes of this board yet.{" "}
          {status?.may_write ? "" : "To save one: indurop serve --write."}</p>}
        {recipes.length > 0 && (
          <Figures label="Recipes">
              <thead><tr><th scope="col">Recipe</th><th scope="col" class="number">Values</th><th scope="col">Saved</th><th scope="col">Comment</th>
                {status?.may_write && <th scope="col">Orders</th>}</tr></thead>
              <tbody>
                {recipes.map(({ recipe, values, saved_wall_ns, who, comment }) => (
                  <tr key={recipe}>
                    <th scope="row"><button type="button" aria-pressed={recipe === chosen} onClick={() => change_query({ r: recipe })}>{recipe}</button></th>
                    <td class="number">{values}</td><td>{clock(saved_wall_ns)}{who && ` by ${who}`}</td><td>{comment || "-"}</td>
                    {status?.may_write && <td><span class="orders">
                      <button type="button" class="main" aria-label={`Load ${recipe}`} onClick={() => order(recipe, "load", {})}>load</button>
                      <button type="button" aria-label={`Remove ${recipe}`} onClick={() => order(recipe, "remove", {})}>remove</button>
                    </span></td>}
                  </tr>))}
              </tbody>
          </Figures>)}
      </Panel>
      {recipes.some(({ recipe }) => recipe === chosen) && <Panel title={`${chosen} and what is now`}><Values board={board} name={chosen} /></Panel>}
    </>);
}
