// SPDX-License-Identifier: Apache-2.0
// What every view needs: whether the server answers, which boards there are, which one is selected.

import { get, message_of, RequestError, token } from "../api/http";
import { stream, type Link } from "../api/stream";
import { ROLES, type BoardSummary, type Role, type ServerStatus } from "../api/types";
import { place } from "../ui/address";
import { reconnected, Store, useStore } from "../ui/store";

const POLL_MS = 2000;

export interface Plant {
  link: Link;
  status: ServerStatus | null;
  boards: BoardSummary[] | null;
  error: string;
  admitted: boolean;  // false: the server requires a token
}

export const plant = new Store<Plant>({ link: "connecting", status: null, boards: null, error: "", admitted: true });

// Returns whether this page may do what the role permits. The server decides again for each request.
export function useMay(role: Role): boolean {
  const { status } = useStore(plant);
  return !!status?.write && ROLES.indexOf(status.role) >= ROLES.indexOf(role);
}

function update(part: Partial<Plant>): void {
  plant.set({ ...plant.get(), ...part });
}

let polling = false;

// One request at a time: at the start the stream reports boards while the first request is still open.
async function poll(): Promise<void> {
  if (polling) return;
  polling = true;
  const sent = token();
  try {
    const [status, { boards }] = await Promise.all([
      get<ServerStatus>("status"), get<{ boards: BoardSummary[] }>("boards")]);
    update({ status, boards, error: "", admitted: true });
  } catch (error) {
    update({ error: message_of(error), admitted: !(error instanceof RequestError && error.unauthorized) });
  } finally {
    polling = false;
  }
  if (sent && !token()) void poll();  // the token was rejected: continue without one
}

export function start_polling(): void {
  stream.on_link = (link) => {
    update({ link });
    if (link === "lost") void poll();  // a browser does not report why a WebSocket was rejected
    if (link !== "open") return;
    reconnected.set(reconnected.get() + 1);
    void poll();
  };
  stream.on_boards = (reported) => {
    const boards = plant.get().boards;
    const same = reported.every(({ board }) => boards?.some((one) => one.board === board)) && boards?.length === reported.length;
    if (!boards || !same) return void poll();
    update({ boards: boards.map((one) => ({ ...one, ...reported.find(({ board }) => board === one.board) })) });
  };
  stream.on_alarms = (board, { active, unacknowledged, shelved, worst }) => {
    const boards = plant.get().boards;
    const alarms = { active, unacknowledged, shelved, worst };
    if (boards) update({ boards: boards.map((one) => (one.board === board ? { ...one, alarms } : one)) });
  };
  stream.open();
  const poll_again = async () => {
    if (!document.hidden) await poll();
    setTimeout(poll_again, POLL_MS);
  };
  void poll_again();
}

// What a user of a read-only page does to get the right to write.
export function how_to_write({ write, users }: ServerStatus): string {
  if (!write) return "start the server with: indurop serve --write";
  return users ? "sign in as a user who may write" : "open the address that the server prints";
}

// The board that the address names, else the first running one of this host, else the first running one, else the first.
export function useBoard(): BoardSummary | null {
  const { boards } = useStore(plant);
  const named = useStore(place).query.get("board");
  if (!boards) return null;
  return boards.find(({ board }) => board === named) ?? boards.find(({ alive, here }) => alive && here) ?? boards.find(({ alive }) => alive) ?? boards[0] ?? null;
}
