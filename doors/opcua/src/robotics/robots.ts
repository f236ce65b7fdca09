// SPDX-License-Identifier: Apache-2.0
// The robots of all boards by the model of OPC 40010-1. A plant without robots has none of it.

import { board_path, Refused, type ServeClient } from "../serve/http";
import type { RobotDescription, VariableDescription } from "../serve/types";
import { Renewal } from "../space/renewal";
import type { BoardTree, Space } from "../space/tree";
import type { Watched } from "../space/variable";
import type { Shared } from "./branch";
import { Model } from "./model";
import { describe, find_groups, type Group, type Robot } from "./robot";
import { System } from "./system";
import type { View } from "./view";

interface Latest {
  tree: BoardTree;
  layout: string;
  groups: Group[];
  here: boolean;  // the board is on the server's own host
}

export class Robots {
  private readonly views = new Map<string, View>();
  private readonly systems = new Map<string, System>();
  private readonly axes = new Map<string, number>();  // by board and robot, as they were last
  private readonly latest = new Map<string, Latest>();
  private readonly renewal = new Renewal("robots", (board) => this.show(board));
  private model: Promise<Model> | undefined;

  constructor(private readonly client: ServeClient, private readonly space: Space, private readonly version: string) {}

  // By the text of its node id.
  find(node: string): Watched | undefined {
    return this.views.get(node);
  }

  // The board has these variables now. Returns notes for people.
  async update(tree: BoardTree, list: VariableDescription[], here: boolean): Promise<string[]> {
    const { groups, notes } = find_groups(list);
    this.latest.set(tree.board, { tree, layout: tree.layout, groups, here });
    this.renewal.begin_again(tree.board);
    if (groups.length > 0 || this.systems.has(tree.board)) await this.renewal.renew(tree.board);
    return notes;
  }

  // The node of a board has started: the number of axes may be another.
  started(board: string): void {
    this.renewal.begin_again(board);
    if (this.latest.get(board)?.groups.length) void this.renewal.renew(board);
  }

  stop(): void {
    this.renewal.stop();
  }

  private async show(board: string): Promise<void> {
    const { tree, layout, groups, here } = this.latest.get(board)!;
    const robots: Robot[] = [];
    const files = groups.length > 0 && here ? await this.files_of(board) : [];
    for (const group of groups) {
      const key = `${board}/${group.name}`;
      const now = await this.axes_of(board, group);
      if (now === 0) this.renewal.try_again(board);  // its task has not run yet
      const axes = Math.min(now || (this.axes.get(key) ?? 0), group.most_axes);
      this.axes.set(key, axes);
      if (axes > 0) robots.push(describe(group, axes, files));
    }
    if (robots.length === 0 && !this.systems.has(board)) return;
    const shared = await this.shared();
    if (tree.layout !== layout) return;  // its variables have changed meanwhile; it is updated again
    let system = this.systems.get(board);
    if (!system) {
      system = new System(shared, board, here ? this.version : "");
      this.systems.set(board, system);
    }
    this.space.address_space.modelChangeTransaction(() => system.update(robots, tree));
  }

  private async shared(): Promise<Shared> {
    this.model ??= Model.load(this.space.address_space, this.space.namespace);
    return { model: await this.model, space: this.space, views: this.views };
  }

  private async axes_of(board: string, { prefix }: Group): Promise<number> {
    const name = encodeURIComponent(`${prefix}ROBOT_MODULE_STATE.nAXESGROUP`);
    return (await this.client.get<{ value: number }>(board_path(board, `/variables/${name}`))).value;
  }

  // None of a server that rejects this.
  private async files_of(board: string): Promise<RobotDescription[]> {
    try {
      return (await this.client.get<{ robots: RobotDescription[] }>(board_path(board, "/robots"))).robots;
    } catch (error) {
      if (error instanceof Refused && error.code !== 0) return [];
      throw error;
    }
  }
}
