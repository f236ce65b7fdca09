// SPDX-License-Identifier: Apache-2.0
// Follows the tape of a board's node while monitored items want the value of every run: page by page, each beginning where
// the one before it ended, so that no value is missed and none comes twice.

import { MonitoringMode, StatusCodes, type DataValue, type MonitoredItem } from "node-opcua";

import { log, message_of } from "../log";
import { bytes_of } from "../model/part";
import type { Construct } from "../model/values";
import { board_path, Refused, status, type ServeClient } from "../serve/http";
import type { HistoryPage, PastVariable } from "../serve/types";
import { unknown_node, type PartNode } from "../space/variable";
import { entries_of, past_value, value_entry, type Entry } from "./past";

export const MOST_NAMES = 64;  // in a request to the server

const MOST_VALUES = 2000;  // of a page: it is converted in about 20 ms, in which other clients wait
const FULL = MOST_VALUES - MOST_NAMES;  // values of the same time are on one page
const FULL_BYTES = 1_000_000;
const PERIOD_MS = { least: 50, longest: 500 };  // the tape holds two seconds
const RETRY_MS = 500;
const BLANK = 6;  // so many pages without any value while the board has some: there is no tape
const STUCK_MS = 10_000;
const US_OF_MS = 1000;

// Puts a value into the queue of an item.
export type Record = (item: MonitoredItem, value: DataValue) => void;

// A variable or a part of one, and the items that want its values.
interface Track {
  one: PartNode;
  items: Set<MonitoredItem>;
  last: Entry | null;  // what was reported last
  known: Entry | null;  // the last value among that
  gone: boolean;  // it was reported that there is no such variable
  blank: number;  // pages
}

export class Tape {
  private readonly tracks = new Map<string, Track>();  // by the name of the part
  private at_ns: bigint | null = null;  // everything before it was reported
  private next: string | null = null;  // continues the page before, if the names are the same
  private names = "";
  private moved_ms = 0;
  private failed = false;
  private timer: NodeJS.Timeout | undefined;

  constructor(private readonly board: string, private readonly client: ServeClient, private readonly layout: () => string | undefined,
    private readonly construct: Construct, private readonly record: Record) {}

  get size(): number { return this.tracks.size; }

  has(one: PartNode): boolean { return this.tracks.has(one.part.path); }

  add(item: MonitoredItem, one: PartNode): void {
    let track = this.tracks.get(one.part.path);
    if (!track) {
      track = { one, items: new Set(), last: null, known: null, gone: false, blank: 0 };
      this.tracks.set(one.part.path, track);
    }
    track.items.add(item);
    this.timer ??= setTimeout(() => void this.turn(), 0);
  }

  // Returns true if the item has a value: samples can be older than it.
  remove(item: MonitoredItem, one: PartNode): boolean {
    const track = this.tracks.get(one.part.path);
    track?.items.delete(item);
    if (track?.items.size === 0) this.tracks.delete(one.part.path);
    return Boolean(track?.last?.bytes);
  }

  // The item has begun to report: it gets what is known already.
  begin(item: MonitoredItem, one: PartNode): void {
    const last = this.tracks.get(one.part.path)?.last;
    if (last) this.record(item, past_value(last, one.part, this.construct));
  }

  // There is no tape at present: samples are better than nothing.
  is_blank(one: PartNode): boolean {
    return (this.tracks.get(one.part.path)?.blank ?? 0) >= BLANK;
  }

  stop(): void {
    this.tracks.clear();
    clearTimeout(this.timer);
  }

  private async turn(): Promise<void> {
    const begin = process.cpuUsage();
    let wait_ms = this.period();
    try {
      if (await this.read()) wait_ms = 0;
      this.failed = false;
    } catch (error) {
      this.fail(error);
      wait_ms = RETRY_MS;
    }
    if (this.tracks.size === 0) {
      this.timer = undefined;
      this.at_ns = this.next = null;
      return;
    }
    // Never more than half of a core, whatever clients want.
    const { user, system } = process.cpuUsage(begin);
    this.timer = setTimeout(() => void this.turn(), Math.max(wait_ms, (user + system) / US_OF_MS));
  }

  // The pace of the fastest subscription.
  private period(): number {
    let period = PERIOD_MS.longest;
    for (const { items } of this.tracks.values()) {
      for (const item of items) period = Math.min(period, (item.$subscription as any)?.publishingInterval ?? period);
    }
    return Math.max(period, PERIOD_MS.least);
  }

  // Reads a page and reports what is on it. Returns true if there is more.
  private async read(): Promise<boolean> {
    for (const track of this.tracks.values()) this.check(track);
    const tracks = [...this.tracks.values()].filter(({ gone }) => !gone);
    if (tracks.length === 0) return false;
    const names = tracks.map(({ one }) => one.part.path);
    const query = new URLSearchParams({ follow: "true", values: "bytes", most: `${MOST_VALUES}` });
    for (const name of names) query.append("name", name);
    const continues = this.next !== null && this.names === names.join();
    if (continues) query.set("next", this.next!);
    else if (this.at_ns !== null) query.set("from_ns", `${this.at_ns}`);
    const page = await this.client.get_exact<HistoryPage>(board_path(this.board, `/history?${query}`));
    if (page.layout !== this.layout() || !page.variables.every((variable, i) => fits(variable, tracks[i].one))) {
      this.moved_ms = Date.now();
      return false;  // a deployment: its variables are not known here yet
    }
    const end_ns = BigInt(page.end_ns);
    if (this.is_stuck(end_ns)) return true;
    if (end_ns === this.at_ns) return false;
    [this.at_ns, this.next, this.names] = [end_ns, page.next, names.join()];
    page.variables.forEach((variable, i) => this.take(tracks[i], variable));
    const bytes = page.variables.reduce((sum, { values }) => sum + values.length * ((values[0]?.bytes.length ?? 0) / 2), 0);
    return page.variables.reduce((sum, { values }) => sum + values.length, 0) >= FULL || bytes >= FULL_BYTES;
  }

  private check(track: Track): void {
    const gone = track.one.variable.gone || !track.one.shown;
    if (gone && !track.gone) {
      for (const item of reporting(track)) this.record(item, unknown_node());
      track.last = null;
    }
    track.gone = gone;
  }

  // The time of the board was set back: what it called the future is given up.
  private is_stuck(end_ns: bigint): boolean {
    if (this.at_ns === null || end_ns > this.at_ns) this.moved_ms = Date.now();
    if (Date.now() - this.moved_ms < STUCK_MS) return false;
    for (const track of this.tracks.values()) this.report(track, { time_ns: this.at_ns!, bytes: null, code: StatusCodes.BadDataLost });
    this.at_ns = this.next = null;
    this.moved_ms = Date.now();
    return true;
  }

  private take(track: Track, variable: PastVariable): void {
    const entries = entries_of(variable);
    if (track.last === null && variable.before) entries.unshift(value_entry(variable.before));
    // The server is back, and nothing has changed meanwhile.
    if (entries.length === 0 && track.last?.code === StatusCodes.BadNoCommunication && track.known) entries.push(track.known);
    for (const entry of entries) {
      if (entry.bytes || track.last?.code !== StatusCodes.BadDataLost) this.report(track, entry);
    }
    track.blank = track.last?.code === StatusCodes.BadDataLost && !track.one.variable.is_bad ? track.blank + 1 : 0;
  }

  private report(track: Track, entry: Entry): void {
    track.last = entry;
    track.known = entry.bytes ? entry : track.known;
    const value = past_value(entry, track.one.part, this.construct);
    for (const item of reporting(track)) this.record(item, value.clone());
  }

  private fail(error: unknown): void {
    const code = error instanceof Refused ? error.code : -1;
    if (code === status.bad_request) this.next = null;
    if (!this.failed) log(`${this.board}: its tape cannot be followed: ${message_of(error)}`);
    this.failed = true;
    // A deployment, or a server that has too much to do: that passes.
    if (code === status.bad_request || code === status.wrong_value || code === status.unavailable) return;
    for (const track of this.tracks.values()) {
      if (track.last?.code === StatusCodes.BadNoCommunication || track.gone) continue;
      this.report(track, { time_ns: this.at_ns ?? BigInt(Date.now()) * 1_000_000n, bytes: null, code: StatusCodes.BadNoCommunication });
    }
  }
}

function reporting({ items }: Track): MonitoredItem[] {
  return [...items].filter(({ monitoringMode }) => monitoringMode === MonitoringMode.Reporting || monitoringMode === MonitoringMode.Sampling);
}

function fits(variable: PastVariable, one: PartNode): boolean {
  const size = 2 * bytes_of(one.part.form);
  return variable.values.every(({ bytes }) => bytes.length === size) && (variable.before?.bytes.length ?? size) === size;
}
