// SPDX-License-Identifier: Apache-2.0
// Shows something of each board: one attempt at a time, and another one later where it failed.

import { log, message_of } from "../log";

const RETRY_MS = 1000;  // at first, then twice as long each time
const LONGEST_RETRY_MS = 60_000;

export class Renewal {
  private readonly turns = new Map<string, Promise<void>>();
  private readonly retries = new Map<string, NodeJS.Timeout>();
  private readonly tries = new Map<string, number>();  // since begin_again()

  // what: subject of the message about a failure, in the plural.
  constructor(private readonly what: string, private readonly show: (board: string) => Promise<void>) {}

  // After all attempts that have begun. Never rejects.
  renew(board: string): Promise<void> {
    clearTimeout(this.retries.get(board));
    this.retries.delete(board);
    const turn = (this.turns.get(board) ?? Promise.resolve()).then(() => this.show(board)).catch((error) => {
      log(`${board}: its ${this.what} cannot be shown: ${message_of(error)}`);
      this.try_again(board);
    });
    this.turns.set(board, turn);
    return turn;
  }

  try_again(board: string): void {
    if (this.retries.has(board)) return;
    const tries = this.tries.get(board) ?? 0;
    this.tries.set(board, tries + 1);
    this.retries.set(board, setTimeout(() => void this.renew(board), Math.min(RETRY_MS * 2 ** tries, LONGEST_RETRY_MS)));
  }

  // Something has changed: the next failure is the first one.
  begin_again(board: string): void {
    this.tries.delete(board);
  }

  stop(): void {
    for (const retry of this.retries.values()) clearTimeout(retry);
  }
}
