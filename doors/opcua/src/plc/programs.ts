// SPDX-License-Identifier: Apache-2.0
// The PLC programs of all boards by the model of OPC 30000: those that `indurop serve --plc` was given and the board
// runs. A plant without them has none of it.

import { log } from "../log";
import { board_path, Refused, type ServeClient } from "../serve/http";
import type { ModuleDescription, PlcDescription } from "../serve/types";
import { Renewal } from "../space/renewal";
import type { BoardTree, Space } from "../space/tree";
import type { Local } from "./local";
import { PlcModel } from "./model";
import { PouTypes } from "./pou_types";
import { Configuration } from "./resource";

interface Latest {
  tree: BoardTree;
  layout: string;
  here: boolean;  // the board is on the server's own host
}

interface Loaded {
  model: PlcModel;
  types: PouTypes;
}

export class Programs {
  private readonly configurations = new Map<string, Configuration>();  // by board
  private readonly latest = new Map<string, Latest>();
  private readonly renewal = new Renewal("PLC programs", (board) => this.show(board));
  private loading: Promise<Loaded> | undefined;

  constructor(private readonly client: ServeClient, private readonly space: Space, private readonly version: string) {}

  // Variables and instances of all programs.
  get size(): number {
    return [...this.configurations.values()].reduce((sum, { instances }) => sum + instances.size, 0);
  }

  // By the text of its node id.
  find(node: string): Local | undefined {
    for (const configuration of this.configurations.values()) {
      const local = configuration.instances.find(node);
      if (local) return local;
    }
    return undefined;
  }

  // The board has these variables now.
  update(tree: BoardTree, here: boolean): Promise<void> {
    this.latest.set(tree.board, { tree, layout: tree.layout, here });
    this.renewal.begin_again(tree.board);
    return this.renewal.renew(tree.board);
  }

  sweep(): void {
    for (const { instances } of this.configurations.values()) this.space.address_space.modelChangeTransaction(() => instances.sweep());
  }

  stop(): void {
    this.renewal.stop();
  }

  private async show(board: string): Promise<void> {
    const { tree, layout, here } = this.latest.get(board)!;
    const before = this.configurations.get(board);
    const expected = (here && before?.expected(tree)) || [];
    const programs = here ? await this.programs_of(board, expected) : [];
    if (programs.length > 0 || (before && !before.is_empty)) await this.place(tree, layout, programs);
    // A program that is exchanged is not the one in the server's files until these are read again.
    if (expected.some((name) => !programs.some(({ program }) => program === name))) this.renewal.try_again(board);
    else this.renewal.begin_again(board);
  }

  private async place(tree: BoardTree, layout: string, programs: PlcDescription[]): Promise<void> {
    const { board } = tree;
    const { modules } = programs.length > 0 ? await this.client.get<{ modules: ModuleDescription[] }>(board_path(board, "/modules")) : { modules: [] };
    const { model, types } = await (this.loading ??= this.load());
    for (const program of programs) types.prepare(program.types);
    await this.space.types.register();
    if (tree.layout !== layout) return;  // its variables have changed meanwhile; it is updated again
    let configuration = this.configurations.get(board);
    this.space.address_space.modelChangeTransaction(() => {
      if (!configuration) {
        configuration = new Configuration(this.space, model, types, board, this.version);
        this.configurations.set(board, configuration);
      }
      configuration.update(programs, modules, tree, () => this.renewal.try_again(board));
    });
    if (configuration!.instances.too_many) log(`${board}: its PLC programs have more than 50000 variables and instances: not all are shown by the PLCopen model`);
  }

  private async load(): Promise<Loaded> {
    const model = await PlcModel.load(this.space.address_space, this.space.namespace);
    this.space.types.of_iec = model.data_type;
    return { model, types: new PouTypes(model, this.space.namespace, this.space.types) };
  }

  // None if the server was given none, or the board runs none of them. expected: those that it ran before.
  private async programs_of(board: string, expected: string[]): Promise<PlcDescription[]> {
    const first = await this.program_of(board, "", expected.length > 0);
    if (!first) return [];
    const all: PlcDescription[] = [];
    for (const name of first.programs) {
      const one = name === first.program ? first : await this.program_of(board, `?program=${encodeURIComponent(name)}`, expected.includes(name));
      if (one) all.push(one);
    }
    return all;
  }

  // again: the server reads the files of a program that was exchanged with the next request.
  private async program_of(board: string, query: string, again: boolean): Promise<PlcDescription | undefined> {
    try {
      return await this.client.get<PlcDescription>(board_path(board, `/plc/model${query}`));
    } catch (error) {
      if (!(error instanceof Refused) || error.code === 0) throw error;
      return again ? this.program_of(board, query, false) : undefined;
    }
  }
}
