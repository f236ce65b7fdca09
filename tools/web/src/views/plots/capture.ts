// SPDX-License-Identifier: Apache-2.0
// Captures of a scope: every tick around a trigger, which the server reads from the node's tape.

import { board_path, get, message_of, RequestError } from "../../api/http";
import type { Capture } from "../../api/types";
import type { Scope } from "./layout";
import type { Samples } from "./recorder";

const TIMEOUT_MS = 70_000;  // the server waits for the ticks after the trigger
const RETRY_MS = 1000;
const AUTO_MS = 500;

// Times are seconds from the trigger, or from the first tick.
export class CapturedSamples implements Samples {
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
    const columns = names.map((name) => { const unit = lines.find((line) => line.name === name)?.unit; return unit ? `${name} [${unit}]` : name; });
    const rows = [["tick", "time_s", ...columns].map((text) => (/[",]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text)).join(",")];
    for (let row = 0; row < this.size; row++) {
      const values = names.map((name) => this.column(name)?.[row] ?? NaN);
      rows.push([first_tick + row, this.times[row], ...values.map((value) => (Number.isNaN(value) ? "" : value))].join(","));
    }
    return `${rows.join("\n")}\n`;
  }
}

interface Listener {
  captured: (samples: CapturedSamples) => void;
  waiting: (status: string) => void;
  rejected: (problem: string) => void;
}

// Requests one capture after the other until it is ended; in single mode only one.
export function capture_until_ended(board: string, names: string[], scope: Scope, listener: Listener): () => void {
  let ended = false;
  let after = -1;
  const request = (trigger: string, timeout_ms: number) => {
    const query = new URLSearchParams(names.map((name) => ["channel", name]));
    query.set("pre", String(scope.pre));
    query.set("post", String(scope.post));
    query.set("timeout_ms", String(timeout_ms));
    if (trigger) query.set("trigger", trigger);
    if (trigger && after >= 0) query.set("after_tick", String(after));
    return get<{ capture: Capture | null }>(board_path(board, `/scope?${query}`), TIMEOUT_MS);
  };
  const run = async () => {
    while (!ended) {
      let pause = 0;
      try {
        let { capture } = await request(scope.trigger, scope.mode === "auto" ? AUTO_MS : 2000);
        if (!capture && scope.mode === "auto" && !ended) ({ capture } = await request("", 2000));
        if (ended) return;
        if (capture) {
          after = capture.first_tick + capture.rows - 1;
          listener.captured(new CapturedSamples(capture));
          if (scope.mode === "single") return;
          pause = scope.trigger ? 100 : RETRY_MS;  // slow enough to read
        } else {
          listener.waiting(`Waiting for: ${scope.trigger}`);
        }
      } catch (error) {
        if (ended) return;
        listener.rejected(message_of(error));
        if (error instanceof RequestError && [400, 422].includes(error.status)) return;
        pause = RETRY_MS;
      }
      if (pause) await new Promise((done) => setTimeout(done, pause));
    }
  };
  void run();
  return () => { ended = true; };
}
