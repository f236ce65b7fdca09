// SPDX-License-Identifier: Apache-2.0
// Forces that this page holds: renewed as long as it is open, whatever view is shown. A page that is closed, disconnected
// or suspended by its browser does not renew them, and the server releases them.

import { board_path, message_of, post, post_without_answer } from "../api/http";
import { Store } from "../ui/store";

export interface Held {
  board: string;
  lease: string;
  names: string[];
}

interface Leases {
  held: Held[];
  lost: string;  // what was released without this page, as text
}

export const leases = new Store<Leases>({ held: [], lost: "" });
let timer = 0;

function path({ board, lease }: Held, act: string): string {
  return board_path(board, `/leases/${lease}/${act}`);
}

async function renew(one: Held): Promise<void> {
  try {
    await post(path(one, "renew"), undefined);
  } catch (error) {
    const { held } = leases.get();
    if (!held.includes(one)) return;  // ended meanwhile
    leases.set({ held: held.filter((other) => other !== one), lost: `${one.names.join(", ")}: ${message_of(error)}` });
  }
}

export function add_lease(one: Held, lease_ns: number): void {
  leases.set({ held: [...leases.get().held, one], lost: "" });
  if (!timer) timer = window.setInterval(() => leases.get().held.forEach((each) => void renew(each)), lease_ns / 4e6);
}

window.addEventListener("pagehide", () => {
  for (const one of leases.get().held) post_without_answer(path(one, "end"));
});
