// SPDX-License-Identifier: Apache-2.0
// All numbers of the board, to be clicked or dragged into a chart.

import { useState } from "preact/hooks";
import { Name } from "../../ui/parts";

const MAX_SHOWN = 100;

export function Picker({ names, add }: { names: string[]; add: (name: string) => void }) {
  const [search, set_search] = useState("");
  const wanted = search.toLowerCase().split(/\s+/).filter(Boolean);
  const found = names.filter((name) => wanted.every((word) => name.toLowerCase().includes(word)));
  return (
    <section class="panel picker" aria-label="Numbers to plot">
      <label class="search"><span class="hidden">Search numbers</span>
        <input type="search" placeholder="Search numbers to plot" value={search} onInput={(event) => set_search(event.currentTarget.value)} /></label>
      <ul>
        {found.slice(0, MAX_SHOWN).map((name) => (
          <li key={name}>
            <button type="button" draggable title="Click to add to the last chart, or drag into any" onClick={() => add(name)}
              onDragStart={(event) => event.dataTransfer?.setData("text/plain", name)}><Name text={name} /></button>
          </li>))}
      </ul>
      {found.length > MAX_SHOWN && <p class="quiet">{found.length - MAX_SHOWN} more; use the search.</p>}
      {found.length === 0 && <p class="quiet">{names.length === 0 ? "There are no numbers to plot." : "No number matches."}</p>}
    </section>);
}
