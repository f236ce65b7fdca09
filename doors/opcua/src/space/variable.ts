// SPDX-License-Identifier: Apache-2.0
// A variable of a board: its newest bytes, and the nodes of the variable and its parts.

import { DataValue, StatusCodes, Variant, type BaseNode, type StatusCode } from "node-opcua";

import { bytes_of, type Part } from "../model/part";
import { variant_at, type Construct } from "../model/values";
import { put_value, type InnerVariable } from "./internals";

// A node that has the value of a part, or one that is derived from it.
export interface Watched {
  part: Part;
  node: InnerVariable;
  variable: Variable;
  items: number;  // monitored items
  derive?: Derive;
  marked?: boolean;  // its value is there only if the variable has the mark that is expected
}

// Of the data of a PLC program: its first 8 bytes are 0 until the program has run, and differ if another one runs.
export interface Mark {
  expected: Buffer;
  on_other: () => void;
}

// From the part's value. null: it does not say that.
export type Derive = (value: any) => Variant | null;

export interface PartNode extends Watched {
  parent: BaseNode;
  shown: boolean;  // it has a place in the tree
}

// Where a group of variables is received.
export interface Source {
  bytes: Buffer | null;  // of the newest frame
  alive: boolean;
  wall_ms: number;
}

const NO_MARK = Buffer.alloc(8);
const QUALITY = 3;  // bits of a frame's quality byte
const FORCED = 4;
const BY_QUALITY: StatusCode[] = [
  StatusCodes.Good,
  StatusCodes.UncertainLastUsableValue,  // stale
  StatusCodes.UncertainNoCommunicationLastUsableValue,  // silent
  StatusCodes.BadDataUnavailable,  // unread
];
const SERVER_ONLY = new DataValue({ statusCode: StatusCodes.BadNodeIdUnknown });

function code_of(alive: boolean, quality: number): StatusCode {
  if (!alive) return StatusCodes.BadOutOfService;
  return (quality & FORCED) !== 0 ? StatusCodes.GoodLocalOverride : BY_QUALITY[quality & QUALITY];
}

export class Variable {
  readonly parts = new Map<string, PartNode>();
  readonly monitored = new Set<Watched>();
  mark: Mark | undefined;
  gone = false;  // its board has no such variable any more
  taped = false;  // the tape of its node has its values of all runs
  wanted_until_ms = 0;
  waiting: (() => void)[] = [];  // reads that wait for the first frame
  private bytes: Buffer | null = null;  // of the frame
  private offset = 0;
  private code: StatusCode = StatusCodes.BadWaitingForInitialData;
  private changed = new Date();

  constructor(readonly board: string, public part: Part, private readonly construct: Construct) {}

  get known(): boolean { return this.bytes !== null || this.gone; }

  get is_bad(): boolean { return this.bytes === null || this.code.isBad(); }

  // A frame has arrived; `offset` is the variable's place in it.
  receive(source: Source, offset: number, quality: number): void {
    const code = code_of(source.alive, quality);
    const before = this.bytes;
    const moved = before === null || !same_bytes(before, this.offset, source.bytes!, offset, bytes_of(this.part.form));
    const [old_offset, old_code] = [this.offset, this.code];
    this.bytes = source.bytes;
    this.offset = offset;
    if (!moved && code === old_code) return;
    this.code = code;
    this.changed = new Date(source.wall_ms);
    const other = this.mark !== undefined && (before === null || !same_bytes(before, old_offset, this.bytes!, offset, NO_MARK.length));
    if (other && this.mark_code() === StatusCodes.BadConfigurationError) this.mark!.on_other();
    for (const one of this.monitored) {
      const { part } = one;
      if (before === null || code !== old_code || (other && one.marked)
        || !same_bytes(before, old_offset + part.offset, this.bytes!, offset + part.offset, bytes_of(part.form))) {
        this.tell(one);
      }
    }
    this.wake();
  }

  // There are no values: what was received belongs to another layout, or another board, or was lost.
  lose(code: StatusCode): void {
    this.bytes = null;
    if (code === this.code) return;
    this.code = code;
    if (code === StatusCodes.BadWaitingForInitialData) return;  // clients keep what they have: values come soon
    this.changed = new Date();
    for (const one of this.monitored) this.tell(one);
    this.wake();
  }

  value_for({ part, derive, marked }: Watched): DataValue {
    const code = marked && this.bytes !== null && !this.code.isBad() ? this.mark_code() ?? this.code : this.code;
    const bad = this.bytes === null || code.isBad();
    let value: Variant | null = bad ? new Variant() : variant_at(this.bytes!, this.offset + part.offset, part.form, this.construct);
    if (derive && !bad) value = derive(value.value);
    return new DataValue({
      value: value ?? new Variant(),
      statusCode: value ? code : StatusCodes.BadNotSupported,
      sourceTimestamp: this.changed,
      serverTimestamp: new Date(),
    });
  }

  wake(): void {
    const waiting = this.waiting;
    this.waiting = [];
    for (const done of waiting) done();
  }

  // Why the data is not that of the expected program; nothing: it is.
  private mark_code(): StatusCode | undefined {
    const is = (mark: Buffer): boolean => same_bytes(mark, 0, this.bytes!, this.offset, mark.length);
    if (!this.mark || is(this.mark.expected)) return undefined;
    return is(NO_MARK) ? StatusCodes.BadWaitingForInitialData : StatusCodes.BadConfigurationError;
  }

  private tell(one: Watched): void {
    const value = this.value_for(one);
    if (one.derive && is_same(value, one.node.$dataValue)) return;  // of a struct, other fields have changed
    put_value(one.node, value);
  }
}

export function unknown_node(): DataValue {
  return SERVER_ONLY.clone();
}

function is_same(a: DataValue, b: DataValue): boolean {
  return a.statusCode === b.statusCode && a.value.value === b.value.value;
}

function same_bytes(a: Buffer, at_a: number, b: Buffer, at_b: number, length: number): boolean {
  if (length > 16) return a.compare(b, at_b, at_b + length, at_a, at_a + length) === 0;
  for (let i = 0; i < length; i++) {
    if (a[at_a + i] !== b[at_b + i]) return false;
  }
  return true;
}
