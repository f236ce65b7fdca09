// SPDX-License-Identifier: Apache-2.0
// What every view needs to know: is the server there, which boards are there, which one is looked at.

import { get, Refusal, token, words } from "../api/http";
import { stream, type Link } from "../api/stream";
import type { BoardSummary, ServerStatus } from "../api/types";
import { place } from "../ui/address";
import { Store, turned, useStore } from "../ui/store";

const LOOK_MS = 2000;

export interface Plant {
  link: Link;
  status: ServerStatus | null;
  boards: BoardSummary[] | null;
  error: string;
  let_in: boolean;  // false: the server is there and wants a token
}

export const plant = new Store<Plant>({ link: "connecting", status: null, boards: null, error: "", let_in: true });

function update(part: Partial<Plant>): void {
  plant.set({ ...plant.get(), ...part });
}

let looking = false;

// One question at a time: at the start the stream opens and tells of boards while the first one is still open.
async function look(): Promise<void> {
  if (looking) return;
  looking = true;
  const shown = token();
  try {
    const [status, { boards }] = await Promise.all([
      get<ServerStatus>("status"), get<{ boards: BoardSummary[] }>("boards")]);
    update({ status, boards, error: "", let_in: true });
  } catch (error) {
    update({ error: words(error), let_in: !(error instanceof Refusal && error.unauthorized) });
  } finally {
    looking = false;
  }
  if (shown && !token()) void look();  // it was refused: without one
}

export function start_looking(): void {
  stream.on_link = (link) => {
    update({ link });
    if (link === "lost") void look();  // a browser does not say why a WebSocket was refused
    if (link !== "open") return;
    turned.set(turned.get() + 1);
    void look();
  };
  stream.on_boards = (seen) => {
    const boards = plant.get().boards;
    const known = seen.every(({ board }) => boards?.some((one) => one.board === board)) && boards?.length === seen.length;
    if (!boards || !known) return void look();
    update({ boards: boards.map((one) => ({ ...one, ...seen.find(({ board }) => board === one.board) })) });
  };
  stream.on_alarms = (board, { active, unacknowledged, shelved, worst }) => {
    const boards = plant.get().boards;
    const alarms = { active, unacknowledged, shelved, worst };
    if (boards) update({ boards: boards.map((one) => (one.board === board ? { ...one, alarms } : one)) });
  };
  stream.open();
  const again = async () => {
    if (!document.hidden) await look();
    setTimeout(again, LOOK_MS);
  };
  void again();
}

// The board the address names, else the first of this host that runs, else the first that runs, else the first.
export function useBoard(): BoardSummary | null {
  const { boards } = useStore(plant);
  const named = useStore(place).query.get("board");
  if (!boards) return null;
  return boards.find(({ board }) => board === named) ?? boards.find(({ alive, here }) => alive && here) ?? boards.find(({ alive }) => alive) ?? boards[0] ?? null;
}
