// SPDX-License-Identifier: Apache-2.0
// History (OPC 10000-11): the raw values of a variable between two times, as `indurop serve` has them, page by page. This
// program keeps nothing of it: a continuation point says where the values that were returned have ended.

import {
  extractRange, HistoryData, HistoryReadResult, ReadRawModifiedDetails, StatusCodes, type DataValue, type HistoryReadDetails, type NumericRange,
  type StatusCode,
} from "node-opcua";

import { log, message_of } from "../log";
import { bytes_of } from "../model/part";
import type { Construct } from "../model/values";
import { board_path, Refused, status, type ServeClient } from "../serve/http";
import type { HistoryPage } from "../serve/types";
import type { HistoryRead } from "../space/internals";
import type { PartNode } from "../space/variable";
import { entries_of as entries_of_variable, NS_OF_MS, past_value, PS_OF_NS, value_entry, type Entry } from "./past";
import { code_of } from "./write";

export const MOST_VALUES = 10_000;  // of a node, in one answer

const PAGES = 20;  // that are read for an answer
const WINDOW_NS = 1_000_000_000n;  // the first time that is read backward; each further one is longer
const LONGER = 4n;
const WINDOWS = 12;
const BOUND_NS = 10_000_000_000n;  // how far beyond the end a bounding value is looked for
const DATE_NS = 100n;  // a client cannot say a time more exactly

interface Wanted {
  from_ns: bigint | null;
  to_ns: bigint | null;
  most: number;
  bounds: boolean;
}

// Where an answer ended: forward the page, and how many of its entries were returned; backward the time.
interface Place {
  node: string;
  next?: string | null;
  skip?: number;
  before?: string;
}

interface Found {
  entries: Entry[];
  place: Place | null;  // null: that was all
}

class Impossible extends Error {
  constructor(readonly code: StatusCode) {
    super(code.description);
  }
}

function code_of_history(error: unknown): StatusCode {
  if (error instanceof Impossible) return error.code;
  if (error instanceof Refused && error.code === status.conflict) return StatusCodes.BadHistoryOperationUnsupported;
  // What else is in a request was checked here.
  if (error instanceof Refused && error.code === status.bad_request) return StatusCodes.BadContinuationPointInvalid;
  return code_of(error);
}

// null: the client did not say.
function ns_of(date: (Date & { picoseconds?: number }) | null): bigint | null {
  if (!date || date.getTime() <= 0) return null;
  return BigInt(date.getTime()) * NS_OF_MS + BigInt(Math.floor((date.picoseconds ?? 0) / PS_OF_NS));
}

function wanted_of(details: ReadRawModifiedDetails): Wanted {
  if (details.isReadModified) throw new Impossible(StatusCodes.BadHistoryOperationUnsupported);
  const from_ns = ns_of(details.startTime);
  const to_ns = ns_of(details.endTime);
  const count = details.numValuesPerNode;
  if ([from_ns !== null, to_ns !== null, count > 0].filter(Boolean).length < 2) throw new Impossible(StatusCodes.BadHistoryOperationInvalid);
  return { from_ns, to_ns, most: Math.min(count || MOST_VALUES, MOST_VALUES), bounds: details.returnBounds };
}

function place_of(point: Buffer | null | undefined, node: string): Place | null {
  if (!point?.length) return null;
  try {
    const place = JSON.parse(point.toString()) as Place;
    const good = place.node === node && (place.before === undefined || /^\d{1,19}$/.test(place.before))
      && Number.isInteger(place.skip ?? 0) && (place.skip ?? 0) >= 0;
    if (good) return place;
  } catch {
    // Answered like any other that is not ours.
  }
  throw new Impossible(StatusCodes.BadContinuationPointInvalid);
}

function entries_of(page: HistoryPage): Entry[] {
  return entries_of_variable(page.variables[0]);
}

function no_bound(time_ns: bigint): Entry {
  return { time_ns, bytes: null, code: StatusCodes.BadBoundNotFound };
}

export class History {
  constructor(private readonly client: ServeClient, private readonly by_node: Map<string, PartNode>,
    private readonly layout_of: (board: string) => string | undefined, private readonly construct: Construct) {}

  // What node-opcua calls for a variable.
  make_read(): HistoryRead {
    const history = this;
    return function history_read(this, _context, details, range, _encoding, continuation, done): void {
      history.answer(this.nodeId.toString(), details, range, continuation).then((result) => done(null, result), (error) => {
        if (!(error instanceof Impossible)) log(`${this.nodeId.toString()}: its history cannot be read: ${message_of(error)}`);
        done(null, new HistoryReadResult({ statusCode: code_of_history(error) }));
      });
    };
  }

  private async answer(node: string, details: HistoryReadDetails, range: NumericRange,
    continuation: { continuationPoint?: Buffer; releaseContinuationPoints?: boolean }): Promise<HistoryReadResult> {
    const one = this.by_node.get(node);
    if (!one || one.variable.gone) throw new Impossible(StatusCodes.BadNodeIdUnknown);
    if (!(details instanceof ReadRawModifiedDetails)) throw new Impossible(StatusCodes.BadHistoryOperationUnsupported);
    const place = place_of(continuation.continuationPoint, node);
    if (continuation.releaseContinuationPoints) return new HistoryReadResult({ statusCode: StatusCodes.Good });
    const wanted = wanted_of(details);
    const is_forward = wanted.from_ns !== null && (wanted.to_ns === null || wanted.from_ns <= wanted.to_ns);
    const found = is_forward ? await this.forward(one, node, wanted, place) : await this.backward(one, node, wanted, place);
    const nothing = !found.place && found.entries.every(({ code }) => code === StatusCodes.BadDataLost);
    return new HistoryReadResult({
      statusCode: nothing ? StatusCodes.GoodNoData : StatusCodes.Good,
      continuationPoint: found.place ? Buffer.from(JSON.stringify(found.place)) : undefined,
      historyData: new HistoryData({ dataValues: nothing ? [] : found.entries.map((entry) => this.data_value(one, entry, range)) }),
    });
  }

  private data_value(one: PartNode, entry: Entry, range: NumericRange): DataValue {
    const value = past_value(entry, one.part, this.construct);
    return entry.bytes && range && !range.isEmpty() ? extractRange(value, range) : value;
  }

  private async page(one: PartNode, from_ns: bigint, to_ns: bigint | null, most: number, next?: string | null): Promise<HistoryPage> {
    const query = new URLSearchParams({ name: one.part.path, from_ns: `${from_ns}`, most: `${most}`, values: "bytes" });
    if (to_ns !== null) query.set("to_ns", `${to_ns}`);
    if (next) query.set("next", next);
    const page = await this.client.get_exact<HistoryPage>(board_path(one.variable.board, `/history?${query}`));
    const size = bytes_of(one.part.form);
    const [variable] = page.variables;
    const fits = [...variable.values, ...(variable.before ? [variable.before] : [])].every(({ bytes }) => bytes.length === 2 * size);
    if (page.layout !== this.layout_of(one.variable.board) || !fits) throw new Impossible(StatusCodes.BadInvalidState);  // a deployment
    return page;
  }

  private async forward(one: PartNode, node: string, wanted: Wanted, place: Place | null): Promise<Found> {
    const from_ns = wanted.from_ns!;
    const to_ns = wanted.to_ns === from_ns ? from_ns + NS_OF_MS : wanted.to_ns;
    const entries: Entry[] = [];
    let next = place?.next ?? null;
    let skip = place?.skip ?? 0;
    for (let pages = 0; pages < PAGES; pages++) {
      const room = wanted.most - entries.length;
      // A page that is read again has to reach beyond what was sent of it, however few the client asks for now.
      const page = await this.page(one, from_ns, to_ns, Math.min(skip + room, MOST_VALUES), next);
      let more = entries_of(page);
      if (wanted.bounds && next === null) more = this.with_begin(page, more, from_ns);
      if (wanted.bounds && page.next === null && to_ns !== null) more.push(await this.end_bound(one, to_ns));
      entries.push(...more.slice(skip, skip + room));
      if (more.length - skip > room) return { entries, place: { node, next, skip: skip + room } };
      if (page.next === null) return { entries, place: null };
      next = page.next;
      skip = 0;
      if (entries.length === wanted.most) break;
    }
    return { entries, place: { node, next } };
  }

  private with_begin(page: HistoryPage, entries: Entry[], from_ns: bigint): Entry[] {
    if (entries[0]?.bytes && entries[0].time_ns / DATE_NS === from_ns / DATE_NS) return entries;
    const [{ before }] = page.variables;
    return [before ? value_entry(before) : no_bound(from_ns), ...entries];
  }

  private async end_bound(one: PartNode, to_ns: bigint): Promise<Entry> {
    const [first] = entries_of(await this.page(one, to_ns, to_ns + BOUND_NS, 1));
    return first?.bytes ? first : no_bound(to_ns);
  }

  private async backward(one: PartNode, node: string, wanted: Wanted, place: Place | null): Promise<Found> {
    if (wanted.bounds) throw new Impossible(StatusCodes.BadHistoryOperationUnsupported);
    const begin_ns = wanted.to_ns !== null && wanted.from_ns !== null ? wanted.to_ns : 0n;
    let end_ns = place?.before ? BigInt(place.before) : wanted.from_ns ?? wanted.to_ns!;
    const entries: Entry[] = [];
    let window_ns = WINDOW_NS;
    for (let windows = 0; windows < WINDOWS && entries.length <= wanted.most && end_ns > begin_ns; windows++) {
      const from_ns = end_ns - window_ns > begin_ns ? end_ns - window_ns : begin_ns;
      const earlier = await this.window(one, from_ns, end_ns);
      if (!earlier) {  // there are too many values in it
        window_ns /= LONGER;
        continue;
      }
      add_earlier(entries, earlier.reverse());
      end_ns = from_ns;
      if (begin_ns === 0n && !earlier.some(({ bytes }) => bytes) && earlier.at(-1)?.time_ns === from_ns) {
        return { entries: entries.slice(0, wanted.most), place: entries.length > wanted.most ? before(node, entries, wanted.most) : null };
      }
      window_ns *= LONGER;
    }
    if (entries.length > wanted.most) return { entries: entries.slice(0, wanted.most), place: before(node, entries, wanted.most) };
    return { entries, place: end_ns > begin_ns ? { node, before: `${end_ns}` } : null };
  }

  // All entries of a short time; null: they are too many.
  private async window(one: PartNode, from_ns: bigint, to_ns: bigint): Promise<Entry[] | null> {
    const entries: Entry[] = [];
    let next: string | null = null;
    for (let pages = 0; pages < PAGES; pages++) {
      const page: HistoryPage = await this.page(one, from_ns, to_ns, MOST_VALUES, next);
      entries.push(...entries_of(page));
      if (page.next === null) return entries;
      next = page.next;
    }
    return to_ns - from_ns > LONGER ? null : entries;
  }
}

function before(node: string, entries: Entry[], count: number): Place {
  return { node, before: `${entries[count - 1].time_ns}` };
}

// Both are the newest first. What a window begins with may be the value, or the gap, that the one before it ended with.
function add_earlier(entries: Entry[], earlier: Entry[]): void {
  const last = entries.at(-1);
  const [next] = earlier;
  const same = last && next && last.code === next.code && (last.bytes === null ? next.bytes === null : next.bytes?.equals(last.bytes));
  if (same) entries.pop();
  entries.push(...earlier);
}
