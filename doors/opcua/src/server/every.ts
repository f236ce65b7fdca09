// SPDX-License-Identifier: Apache-2.0
// Monitored items that report every run (OPC 10000-4: a sampling interval of 0, and a queue): which they are, and how much
// that may cost. Their values come from the tape of the node, all others' are samples.

import type { DataValue, MonitoredItem, MonitoringParameters, NumericRange } from "node-opcua";

import { log } from "../log";
import { bytes_of } from "../model/part";
import type { Construct } from "../model/values";
import type { ServeClient } from "../serve/http";
import type { PartNode } from "../space/variable";
import { MOST_NAMES, Tape } from "./tape";

export const MOST_QUEUED = 5000;  // node-opcua's limit

const MOST_ITEMS = 100;
const QUEUE_BYTES = 4_000_000;  // of an item, about
const VALUE_BYTES = 500;  // what a value takes in addition
const BYTES_OF_BYTE = 8;

export class Every {
  private readonly tapes = new Map<string, Tape>();  // by board
  private readonly items = new Map<MonitoredItem, PartNode>();
  private readonly originals = new WeakMap<MonitoredItem, MonitoredItem["recordValue"]>();

  constructor(private readonly client: ServeClient, private readonly layout_of: (board: string) => string | undefined,
    private readonly construct: Construct) {}

  // Returns true if an item with these parameters reports every run; they are revised then.
  accepts(one: PartNode, parameters: MonitoringParameters, item?: MonitoredItem): boolean {
    if (parameters.samplingInterval !== 0 || parameters.queueSize <= 1 || !one.variable.taped || one.variable.gone) return false;
    if (!(item && this.items.has(item)) && !this.has_room(one)) {
      log(`${one.node.nodeId.toString()}: a client wants every run, but gets samples: at most ${MOST_ITEMS} items and, of a board, `
        + `${MOST_NAMES} variables report every run`);
      return false;
    }
    const most = Math.floor(QUEUE_BYTES / (VALUE_BYTES + BYTES_OF_BYTE * bytes_of(one.part.form)));
    parameters.queueSize = Math.min(parameters.queueSize, MOST_QUEUED, Math.max(most, 2));
    return true;
  }

  // The item reports every run from now on.
  add(item: MonitoredItem, one: PartNode): void {
    if (this.items.has(item)) return;
    this.items.set(item, one);
    const { board } = one.variable;
    let tape = this.tapes.get(board);
    if (!tape) {
      tape = new Tape(board, this.client, () => this.layout_of(board), this.construct, (...words) => this.record(...words));
      this.tapes.set(board, tape);
    }
    this.take_over(item);
    tape.add(item, one);
  }

  // The item has begun to report, again or for the first time.
  begin(item: MonitoredItem): void {
    const one = this.items.get(item);
    if (one) this.tapes.get(one.variable.board)!.begin(item, one);
  }

  // The item reports samples from now on, or has ended. Returns true if it needs one at once: it has no value.
  remove(item: MonitoredItem): boolean {
    const one = this.items.get(item);
    if (!one) return false;
    this.items.delete(item);
    return !this.tapes.get(one.variable.board)!.remove(item, one);
  }

  stop(): void {
    for (const tape of this.tapes.values()) tape.stop();
  }

  private has_room(one: PartNode): boolean {
    const tape = this.tapes.get(one.variable.board);
    return this.items.size < MOST_ITEMS && (!tape || tape.size < MOST_NAMES || tape.has(one));
  }

  // What node-opcua records of the node are samples.
  private take_over(item: MonitoredItem): void {
    if (this.originals.has(item)) return;
    const original = item.recordValue.bind(item);
    this.originals.set(item, original);
    item.recordValue = (value: DataValue, skip?: boolean, range?: NumericRange) => {
      const one = this.items.get(item);
      if (one && !this.tapes.get(one.variable.board)!.is_blank(one)) return false;
      return original(value, skip, range);
    };
  }

  private record(item: MonitoredItem, value: DataValue): void {
    this.originals.get(item)!(value);
  }
}
