// SPDX-License-Identifier: Apache-2.0
// Shared functions of the boards as methods, in the folder of their namespace.

import type { CallMethodResultOptions, ISessionContext, UAMethod, Variant } from "node-opcua";

import type { Form, FunctionDescription } from "../serve/types";
import type { BoardTree, Space } from "./tree";

export type CallFunction = (board: string, one: FunctionDescription, words: Variant[], context: ISessionContext) => Promise<CallMethodResultOptions>;

export class Methods {
  private readonly known = new Map<string, { board: string; method: UAMethod; signature: string }>();  // by node id

  constructor(private readonly space: Space, private readonly call: CallFunction) {}

  // Methods that are as they were stay as they are.
  async update(tree: BoardTree, functions: FunctionDescription[]): Promise<void> {
    for (const { arguments: words, result } of functions) {
      for (const form of [...words.map((word) => word.form), ...(result ? [result] : [])]) this.space.types.of(form);
    }
    await this.space.types.register();
    const listed = new Map(functions.map((one) => [`ns=${this.space.namespace.index};s=${tree.board}/${one.name}()`, one]));
    for (const [id, { board, method, signature }] of this.known) {
      const now = listed.get(id);
      if (board !== tree.board || (now && signature_of(now) === signature)) continue;
      this.known.delete(id);
      this.space.namespace.deleteNode(method);
    }
    for (const [id, one] of listed) {
      if (!this.known.has(id)) this.known.set(id, { board: tree.board, method: this.add(tree, id, one), signature: signature_of(one) });
    }
  }

  private add(tree: BoardTree, id: string, one: FunctionDescription): UAMethod {
    const argument = (name: string, form: Form, description: string): object => {
      const dims = form.dims ?? [];
      return {
        name, description: { text: description }, dataType: this.space.types.of(form),
        valueRank: dims.length || -1, arrayDimensions: dims.length ? dims : undefined,
      };
    };
    const method = this.space.namespace.addMethod(tree.folder_of(one.name), {
      nodeId: id,
      browseName: one.name.slice(one.name.lastIndexOf(":") + 1),
      description: one.description,
      inputArguments: one.arguments.map((word) => argument(word.name, word.form, describe(word))),
      outputArguments: one.result ? [argument("result", one.result, "")] : [],
    } as any);
    method.bindMethod((words, context, done) => {
      this.call(tree.board, one, words, context).then((result) => done(null, result), (error) => done(error));
    });
    return method;
  }
}

function signature_of({ served: _, ...one }: FunctionDescription): string {
  return JSON.stringify(one);
}

function describe({ description, unit }: FunctionDescription["arguments"][number]): string {
  return [description, unit && `(${unit})`].filter(Boolean).join(" ");
}
