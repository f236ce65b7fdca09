// SPDX-License-Identifier: Apache-2.0
// Which variables are received: those that a client monitors, and those that were read lately. They are subscribed to in
// groups, so that another one costs one small message and no value is requested twice.

import { StatusCodes } from "node-opcua";

import { log } from "../log";
import type { Frame } from "../serve/stream";
import type { Subscribed } from "../serve/types";
import type { Source, Variable } from "./variable";

const GROUPS = 32;  // subscriptions that a client of serve may have
const GROUP_SIZE = 625;  // together 20000, the most variables that a client may follow
const MESSAGE_BYTES = 48_000;  // of the 64 KiB that a message may have
const READ_KEEP_MS = 10_000;
const GATHER_MS = 5;  // variables wanted within this time are requested together
const SWEEP_MS = 2000;
const FIRST_FRAME_MS = 4000;

export interface Subscriber {
  subscribe(id: number, board: string, names: string[], rate_hz: number): void;
  unsubscribe(id: number): void;
}

class Group implements Source {
  readonly variables = new Set<Variable>();
  name_bytes = 0;
  stream = -1;
  places: [Variable, number][] = [];  // with their offsets, in the order of the quality bytes
  quality_offset = 0;
  changed = false;  // to be subscribed to again
  bytes: Buffer | null = null;
  alive = false;
  wall_ms = 0;

  constructor(readonly id: number, readonly board: string) {}

  has_room(name: string): boolean {
    return this.variables.size < GROUP_SIZE && this.name_bytes + name.length < MESSAGE_BYTES;
  }
}

export class Follow {
  private readonly groups = new Map<number, Group>();
  private readonly by_stream = new Map<number, Group>();
  private readonly group_of = new Map<Variable, Group>();
  private gathering: NodeJS.Timeout | undefined;
  private readonly sweeping: NodeJS.Timeout;
  connected = false;
  on_start: (board: string) => void = () => {};  // its node was seen to run again

  constructor(private readonly to: Subscriber, private readonly rate_hz: number) {
    this.sweeping = setInterval(() => this.sweep(), SWEEP_MS);
  }

  stop(): void {
    clearInterval(this.sweeping);
    clearTimeout(this.gathering);
  }

  // The variable's values are received from now on, at least for a while.
  want(variable: Variable): void {
    variable.wanted_until_ms = Date.now() + READ_KEEP_MS;
    if (variable.gone || this.group_of.has(variable)) return;
    const group = this.room_for(variable);
    if (!group) {
      variable.lose(StatusCodes.BadTooManyMonitoredItems);
      return;
    }
    group.variables.add(variable);
    group.name_bytes += variable.part.path.length + 3;
    this.group_of.set(variable, group);
    variable.lose(this.connected ? StatusCodes.BadWaitingForInitialData : StatusCodes.BadNoCommunication);
    this.renew(group);
  }

  // Calls `done` when a value is known, or none is to be had.
  when_known(variable: Variable, done: () => void): void {
    this.want(variable);
    if (variable.known || !this.connected || !this.group_of.has(variable)) {
      done();
      return;
    }
    const timeout = setTimeout(() => {
      variable.waiting = variable.waiting.filter((one) => one !== answer);
      done();
    }, FIRST_FRAME_MS);
    const answer = (): void => {
      clearTimeout(timeout);
      done();
    };
    variable.waiting.push(answer);
  }

  // The board has no such variable any more.
  drop(variable: Variable): void {
    const group = this.group_of.get(variable);
    if (!group) return;
    group.variables.delete(variable);
    group.name_bytes -= variable.part.path.length + 3;
    this.group_of.delete(variable);
    this.renew(group);
  }

  opened(): void {
    this.connected = true;
    for (const group of this.groups.values()) this.renew(group);
  }

  lost(): void {
    this.connected = false;
    this.by_stream.clear();
    for (const group of this.groups.values()) this.forget(group, false);
  }

  // The layout of their board has changed; the list of its variables is requested before they are subscribed to again.
  ended(ids: number[]): void {
    for (const id of ids) {
      const group = this.groups.get(id);
      if (group) this.forget(group, true);
    }
  }

  forget_board(board: string): void {
    for (const group of this.groups.values()) {
      if (group.board === board) this.forget(group, true);
    }
  }

  renew_board(board: string): void {
    for (const group of this.groups.values()) {
      if (group.board === board) this.renew(group);
    }
  }

  subscribed(answer: Subscribed): void {
    const group = this.groups.get(answer.id);
    if (!group) return;
    this.by_stream.delete(group.stream);
    group.stream = answer.stream;
    this.by_stream.set(answer.stream, group);
    group.quality_offset = answer.quality_offset;
    const by_name = new Map([...group.variables].map((variable) => [variable.part.path, variable]));
    // One that was dropped meanwhile has a quality byte all the same.
    group.places = answer.variables.map(({ name, offset }) => [by_name.get(name)!, offset]);
    const found = new Set(group.places.map(([variable]) => variable));
    for (const variable of group.variables) {
      if (!found.has(variable)) variable.lose(StatusCodes.BadDataUnavailable);
    }
  }

  rejected(id: number, message: string): void {
    const group = this.groups.get(id);
    if (!group) return;
    log(`${group.board}: values are not available: ${message}`);
    for (const variable of group.variables) variable.lose(StatusCodes.BadNoCommunication);
    group.changed = true;  // the next sweep tries again
  }

  received(frame: Frame): void {
    const group = this.by_stream.get(frame.stream);
    if (!group) return;
    if (frame.alive && group.bytes && !group.alive) this.on_start(group.board);
    group.bytes = frame.bytes;
    group.alive = frame.alive;
    group.wall_ms = frame.wall_ms;
    group.places.forEach(([variable, offset], i) => {
      if (variable && this.group_of.get(variable) === group) variable.receive(group, offset, frame.bytes[group.quality_offset + i]);
    });
  }

  private forget(group: Group, connected: boolean): void {
    this.by_stream.delete(group.stream);
    group.stream = -1;
    group.places = [];
    group.bytes = null;
    for (const variable of group.variables) {
      variable.lose(connected ? StatusCodes.BadWaitingForInitialData : StatusCodes.BadNoCommunication);
    }
  }

  private room_for(variable: Variable): Group | null {
    for (const group of this.groups.values()) {
      if (group.board === variable.board && group.has_room(variable.part.path)) return group;
    }
    for (let id = 1; id <= GROUPS; id++) {
      if (this.groups.has(id)) continue;
      const group = new Group(id, variable.board);
      this.groups.set(id, group);
      return group;
    }
    return null;
  }

  private renew(group: Group): void {
    group.changed = true;
    this.gathering ??= setTimeout(() => {
      this.gathering = undefined;
      this.send();
    }, GATHER_MS);
  }

  private send(): void {
    if (!this.connected) return;
    for (const group of [...this.groups.values()].filter(({ changed }) => changed)) {
      group.changed = false;
      if (group.variables.size > 0) {
        this.to.subscribe(group.id, group.board, [...group.variables].map(({ part }) => part.path), this.rate_hz);
        continue;
      }
      this.to.unsubscribe(group.id);
      this.by_stream.delete(group.stream);
      this.groups.delete(group.id);
    }
  }

  private sweep(): void {
    const now = Date.now();
    for (const variable of [...this.group_of.keys()]) {
      if (variable.monitored.size === 0 && variable.waiting.length === 0 && variable.wanted_until_ms < now) this.drop(variable);
    }
    this.send();
  }
}
