// SPDX-License-Identifier: Apache-2.0
// Forces that this page holds: renewed as long as it is open, whatever view is shown. A page that is closed, lost or put
// to sleep by its browser does not renew, and the board lets go by itself.

import { board_path, post, post_at_the_end, words } from "../api/http";
import { Store } from "../ui/store";

export interface Held {
  board: string;
  lease: string;
  names: string[];
}

interface Leases {
  held: Held[];
  lost: string;  // what was let go without this page, in words
}

export const leases = new Store<Leases>({ held: [], lost: "" });
let timer = 0;

function path({ board, lease }: Held, what: string): string {
  return board_path(board, `/leases/${lease}/${what}`);
}

async function renew(one: Held): Promise<void> {
  try {
    await post(path(one, "renew"), undefined);
  } catch (error) {
    const { held } = leases.get();
    if (!held.includes(one)) return;  // ended meanwhile
    leases.set({ held: held.filter((other) => other !== one), lost: `${one.names.join(", ")}: ${words(error)}` });
  }
}

export function keep(one: Held, lease_ns: number): void {
  leases.set({ held: [...leases.get().held, one], lost: "" });
  if (!timer) timer = window.setInterval(() => leases.get().held.forEach((each) => void renew(each)), lease_ns / 4e6);
}

window.addEventListener("pagehide", () => {
  for (const one of leases.get().held) post_at_the_end(path(one, "end"));
});
