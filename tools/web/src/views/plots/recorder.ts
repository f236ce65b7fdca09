// SPDX-License-Identifier: Apache-2.0
// The samples of all charts since they were opened; pausing and zooming only show another part of them.

import { decode, quality_of, type Frame } from "../../api/decode";
import { stream } from "../../api/stream";
import type { Subscribed } from "../../api/types";

const MAX_SAMPLES = 60_000;  // 40 minutes at 25 Hz

// What a chart draws. Times increase.
export interface Samples {
  readonly size: number;
  readonly times: Float64Array;
  column(name: string): Float64Array | undefined;
  index_at(time: number): number;  // the first sample at or after it
}

export class Recorder implements Samples {
  size = 0;
  dropped = 0;
  rejected = "";
  missing: string[] = [];
  readonly times = new Float64Array(MAX_SAMPLES);  // s since 1970
  readonly board_times = new Float64Array(MAX_SAMPLES);  // s, the board's
  private readonly columns = new Map<string, Float64Array>();
  private last_seq = -1;
  private end: () => void = () => {};

  follow(board: string, names: string[], rate_hz: number): void {
    this.end();
    this.last_seq = -1;
    for (const name of [...this.columns.keys()]) if (!names.includes(name)) this.columns.delete(name);
    for (const name of names) if (!this.columns.has(name)) this.columns.set(name, new Float64Array(MAX_SAMPLES).fill(NaN));
    if (names.length === 0) this.size = 0;
    this.end = names.length === 0 || !board ? () => {} : stream.subscribe({
      board, names, rate_hz, binary: true,
      subscribed: ({ missing }) => {
        this.rejected = "";
        this.last_seq = -1;
        this.missing = (missing ?? []).map(({ message }) => message);
      },
      frame: (frame, of) => this.add_frame(frame, of),
      dropped: (frames) => { this.dropped += frames; },
      rejected: (message) => { this.rejected = message; },
    });
  }

  stop(): void {
    this.end();
    this.end = () => {};
  }

  column(name: string): Float64Array | undefined {
    return this.columns.get(name);
  }

  index_at(time: number): number {
    let low = 0;
    let high = this.size;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle] < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  private add_frame(frame: Frame, of: Subscribed): void {
    const time = frame.wall_ns / 1e9;
    if (this.size > 0 && time <= this.times[this.size - 1]) return;
    // A lost frame leaves a gap in the line.
    if (this.last_seq >= 0 && frame.seq !== this.last_seq + 1) this.add((time + this.times[this.size - 1]) / 2, NaN, () => NaN);
    this.last_seq = frame.seq;
    const places = new Map(of.variables.map((variable, i) => [variable.name, i]));
    this.add(time, frame.time_ns / 1e9, (name) => {
      const i = places.get(name);
      if (i === undefined || !frame.alive || quality_of(frame, of, i).quality === "unread") return NaN;
      return Number(decode(frame.view, of.variables[i].offset, of.variables[i].form));
    });
  }

  private add(time: number, board_time: number, value: (name: string) => number): void {
    if (this.size === MAX_SAMPLES) this.discard_half();
    this.times[this.size] = time;
    this.board_times[this.size] = board_time;
    for (const [name, column] of this.columns) column[this.size] = value(name);
    this.size++;
  }

  private discard_half(): void {
    const half = MAX_SAMPLES / 2;
    for (const array of [this.times, this.board_times, ...this.columns.values()]) {
      array.copyWithin(0, half);
      array.fill(NaN, half);
    }
    this.size = half;
  }
}
