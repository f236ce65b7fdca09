// SPDX-License-Identifier: Apache-2.0
// All boards: what the stream says about them becomes nodes and values.

import { log, message_of } from "../log";
import { board_path, Refused, status, type ServeClient } from "../serve/http";
import { Stream } from "../serve/stream";
import type { FunctionDescription, StreamBoard, VariableList } from "../serve/types";
import type { Programs } from "../plc/programs";
import type { Robots } from "../robotics/robots";
import { Follow } from "./follow";
import type { Methods } from "./methods";
import { BoardTree, notes_of, type Space } from "./tree";

const RETRY_MS = 2000;
const SWEEP_MS = 2000;
const TAPE_MS = 3000;  // the tape of a node that was seen to start is there

export class Boards {
  readonly trees = new Map<string, BoardTree>();
  readonly follow: Follow;
  on_update: (tree: BoardTree) => Promise<void> = async () => {};  // alarms belong to the new variables
  on_alarms: (board: string) => void = () => {};
  private readonly stream: Stream;
  private readonly updates = new Map<string, Promise<void>>();  // one at a time of each board
  private readonly running = new Set<string>();  // boards with a node
  private readonly noted = new Set<string>();
  private readonly learning = new Map<string, NodeJS.Timeout>();
  private sweeping: NodeJS.Timeout | undefined;
  space!: Space;
  methods!: Methods;
  robots!: Robots;
  programs!: Programs;

  constructor(private readonly client: ServeClient, rate_hz: number) {
    this.stream = new Stream(client, {
      opened: () => this.follow.opened(),
      lost: (why) => this.lost(why),
      boards: (boards) => this.heard(boards),
      alarms: (board) => this.on_alarms(board),
      subscribed: (answer) => this.subscribed(answer.board, answer.layout, () => this.follow.subscribed(answer)),
      frame: (frame) => this.follow.received(frame),
      ended: (ids) => this.follow.ended(ids),
      rejected: (id, message) => this.follow.rejected(id, message),
    });
    this.follow = new Follow(this.stream, rate_hz);
    this.follow.on_start = (board) => this.started(board);
  }

  // Boards that are there now. Throws Refused.
  async begin(): Promise<void> {
    const { boards } = await this.client.get<{ boards: StreamBoard[] }>("boards");
    for (const { board, alive } of boards) if (alive) this.running.add(board);
    await Promise.all(boards.map(({ board, layout }) => this.update(board, layout)));
    this.stream.open();
    this.sweeping = setInterval(() => { this.sweep(); }, SWEEP_MS);
  }

  stop(): void {
    clearInterval(this.sweeping);
    for (const timer of this.learning.values()) clearTimeout(timer);
    this.follow.stop();
    this.robots.stop();
    this.programs.stop();
    this.stream.close();
  }

  private sweep(): void {
    for (const tree of this.trees.values()) tree.sweep();
    this.programs.sweep();
  }

  private lost(why: string): void {
    if (this.follow.connected) log(`${this.client.base.origin} is lost: ${why}; values are bad until it is back`);
    this.follow.lost();
  }

  private heard(boards: StreamBoard[]): void {
    for (const { board, alive, layout } of boards) {
      void this.update(board, layout);
      if (alive && !this.running.has(board) && this.trees.get(board)?.layout === layout) this.started(board);
      if (alive) this.running.add(board);
      else this.running.delete(board);
    }
  }

  // The node of the board has started, with the same variables.
  private started(board: string): void {
    this.robots.started(board);
    this.learn_tape_soon(board);
  }

  private learn_tape_soon(board: string): void {
    clearTimeout(this.learning.get(board));
    this.learning.set(board, setTimeout(() => void this.learn_tape(board), TAPE_MS));
  }

  private async learn_tape(board: string): Promise<void> {
    try {
      const list = await this.client.get<VariableList>(board_path(board, "/variables?values=false"));
      const tree = this.trees.get(board);
      if (tree?.layout === list.layout) tree.set_taped(list.variables);
    } catch (error) {
      log(`${board}: whether it has a tape is not known: ${message_of(error)}`);
    }
  }

  private subscribed(board: string, layout: string, known: () => void): void {
    if (this.trees.get(board)?.layout === layout) known();
    else void this.update(board, layout);
  }

  private update(board: string, layout: string): Promise<void> {
    if (layout === "" || this.trees.get(board)?.layout === layout) return Promise.resolve();
    let running = this.updates.get(board);
    if (!running) {
      running = this.read_variables(board).finally(() => this.updates.delete(board));
      this.updates.set(board, running);
    }
    return running;
  }

  private async read_variables(board: string): Promise<void> {
    try {
      const list = await this.client.get<VariableList>(board_path(board, "/variables?values=false"));
      const { here } = await this.client.get<{ here?: false }>(board_path(board));
      let tree = this.trees.get(board);
      if (!tree) {
        tree = new BoardTree(board, this.space);
        this.trees.set(board, tree);
      }
      this.follow.forget_board(board);
      await tree.update(list.variables, list.layout, here !== false);
      await this.methods.update(tree, here === false ? [] : await this.functions_of(board));
      const unshown = await this.robots.update(tree, list.variables, here !== false);
      await this.programs.update(tree, here !== false);
      this.note([...notes_of(list.variables), ...unshown, ...this.space.types.notes].map((note) => `${board}: ${note}`));
      this.follow.renew_board(board);
      if (here !== false) this.learn_tape_soon(board);
      await this.on_update(tree);
    } catch (error) {
      log(`${board}: its variables cannot be read: ${message_of(error)}`);
      setTimeout(() => void this.update(board, "unknown"), RETRY_MS);
    }
  }

  // None of a server of an earlier release.
  private async functions_of(board: string): Promise<FunctionDescription[]> {
    try {
      return (await this.client.get<{ functions: FunctionDescription[] }>(board_path(board, "/functions"))).functions;
    } catch (error) {
      if (error instanceof Refused && error.code === status.not_found) return [];
      throw error;
    }
  }

  private note(notes: string[]): void {
    for (const note of notes) {
      if (this.noted.has(note)) continue;
      this.noted.add(note);
      log(note);
    }
  }
}
