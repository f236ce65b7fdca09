// SPDX-License-Identifier: Apache-2.0
// Pictures of a scope: every tick around a trigger, as the server takes them from the node's tape.

import { board_path, get, Refusal, words } from "../../api/http";
import type { Capture } from "../../api/types";
import type { Wish } from "./layout";
import type { Samples } from "./recorder";

const PATIENCE_MS = 70_000;  // the server's for what comes after the trigger, and some more
const AGAIN_MS = 1000;
const AUTO_MS = 500;

// Times are seconds from the trigger, or from the first tick.
export class Picture implements Samples {
  readonly size: number;
  readonly times: Float64Array;
  private readonly columns: Map<string, Float64Array>;

  constructor(readonly capture: Capture) {
    const { rows, period_ns, trigger_row, lines } = capture;
    this.size = rows;
    this.times = Float64Array.from({ length: rows }, (_, row) => (row - (trigger_row ?? 0)) * period_ns / 1e9);
    this.columns = new Map(lines.map(({ name, values }) => [name, Float64Array.from(values, (value) => value ?? NaN)]));
  }

  column(name: string): Float64Array | undefined {
    return this.columns.get(name);
  }

  index_at(time: number): number {
    const found = this.times.findIndex((one) => one >= time);
    return found < 0 ? this.size : found;
  }

  csv(names: string[]): string {
    const { first_tick, lines } = this.capture;
    const heads = names.map((name) => { const unit = lines.find((line) => line.name === name)?.unit; return unit ? `${name} [${unit}]` : name; });
    const rows = [["tick", "time_s", ...heads].map((text) => (/[",]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text)).join(",")];
    for (let row = 0; row < this.size; row++) {
      const values = names.map((name) => this.column(name)?.[row] ?? NaN);
      rows.push([first_tick + row, this.times[row], ...values.map((value) => (Number.isNaN(value) ? "" : value))].join(","));
    }
    return `${rows.join("\n")}\n`;
  }
}

interface Told {
  picture: (picture: Picture) => void;
  waiting: (what: string) => void;
  refused: (why: string) => void;
}

// Asks for one picture after the other until it is ended; of a single one only until it came.
export function follow(board: string, names: string[], wish: Wish, told: Told): () => void {
  let ended = false;
  let after = -1;
  const ask = (trigger: string, timeout_ms: number) => {
    const query = new URLSearchParams(names.map((name) => ["channel", name]));
    query.set("pre", String(wish.pre));
    query.set("post", String(wish.post));
    query.set("timeout_ms", String(timeout_ms));
    if (trigger) query.set("trigger", trigger);
    if (trigger && after >= 0) query.set("after_tick", String(after));
    return get<{ capture: Capture | null }>(board_path(board, `/scope?${query}`), PATIENCE_MS);
  };
  const turn = async () => {
    while (!ended) {
      let pause = 0;
      try {
        let { capture } = await ask(wish.trigger, wish.mode === "auto" ? AUTO_MS : 2000);
        if (!capture && wish.mode === "auto" && !ended) ({ capture } = await ask("", 2000));
        if (ended) return;
        if (capture) {
          after = capture.first_tick + capture.rows - 1;
          told.picture(new Picture(capture));
          if (wish.mode === "single") return;
          pause = wish.trigger ? 100 : AGAIN_MS;  // for eyes
        } else {
          told.waiting(`Waiting for: ${wish.trigger}`);
        }
      } catch (error) {
        if (ended) return;
        told.refused(words(error));
        if (error instanceof Refusal && [400, 422].includes(error.status)) return;
        pause = AGAIN_MS;
      }
      if (pause) await new Promise((done) => setTimeout(done, pause));
    }
  };
  void turn();
  return () => { ended = true; };
}
