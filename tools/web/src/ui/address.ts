// SPDX-License-Identifier: Apache-2.0
// The address, after '#', names what the page shows, so that a link or a reload shows it again: #/plots?board=cell&c=a,b

import { Store } from "./store";

export interface Place {
  view: string;
  query: URLSearchParams;
}

function read(): Place {
  const [view, query] = location.hash.replace(/^#\/?/, "").split("?");
  return { view: view || "overview", query: new URLSearchParams(query ?? "") };
}

export const place = new Store<Place>(read());
window.addEventListener("hashchange", () => place.set(read()));

export function address(view: string, query: URLSearchParams | Record<string, string> = {}): string {
  const text = new URLSearchParams(query).toString()
    .replaceAll("%3A", ":").replaceAll("%2C", ",").replaceAll("%5B", "[").replaceAll("%5D", "]");
  return `#/${view}${text ? `?${text}` : ""}`;
}

// Changes parameters in the query of the current view; an empty value removes one. The browser's history stays as it is.
export function change_query(changes: Record<string, string | string[]>): void {
  const { view, query } = place.get();
  const next = new URLSearchParams(query);
  for (const [name, value] of Object.entries(changes)) {
    next.delete(name);
    for (const one of Array.isArray(value) ? value : [value]) if (one !== "") next.append(name, one);
  }
  history.replaceState(null, "", address(view, next));
  place.set(read());
}
