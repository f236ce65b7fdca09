// SPDX-License-Identifier: Apache-2.0
// All numbers there are, to be clicked or dragged into a chart.

import { useState } from "preact/hooks";

const MOST = 100;

export function Picker({ names, add }: { names: string[]; add: (name: string) => void }) {
  const [search, look_for] = useState("");
  const wanted = search.toLowerCase().split(/\s+/).filter(Boolean);
  const found = names.filter((name) => wanted.every((word) => name.toLowerCase().includes(word)));
  return (
    <section class="panel picker" aria-label="Numbers to plot">
      <label class="search"><span class="hidden">Search numbers</span>
        <input type="search" placeholder="Search numbers to plot" value={search} onInput={(event) => look_for(event.currentTarget.value)} /></label>
      <ul>
        {found.slice(0, MOST).map((name) => (
          <li key={name}>
            <button type="button" draggable title="Click to add to the last chart, or drag into any" onClick={() => add(name)}
              onDragStart={(event) => event.dataTransfer?.setData("text/plain", name)}>{name}</button>
          </li>))}
      </ul>
      {found.length > MOST && <p class="quiet">{found.length - MOST} more: search for them.</p>}
      {found.length === 0 && <p class="quiet">No number matches.</p>}
    </section>);
}
