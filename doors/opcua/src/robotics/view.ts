// SPDX-License-Identifier: Apache-2.0
// A variable of the model that has the value of a variable of the board.

import type { UAVariable } from "node-opcua";

import type { Follow } from "../space/follow";
import { put_value, type InnerVariable } from "../space/internals";
import { read_through } from "../space/read";
import type { BoardTree, Space } from "../space/tree";
import { unknown_node, type Derive, type Variable, type Watched } from "../space/variable";
import type { Part } from "../model/part";

export class View implements Watched {
  readonly node: InnerVariable;
  items = 0;

  private constructor(node: UAVariable, readonly path: string, public variable: Variable, public part: Part, readonly derive?: Derive) {
    this.node = node as InnerVariable;
  }

  // path: of a part that the board has.
  static make(node: UAVariable, tree: BoardTree, path: string, { follow, rate_hz }: Space, derive?: Derive): View {
    const { variable, part } = tree.find(path)!;
    const view = new View(node, path, variable, part, derive);
    view.node.minimumSamplingInterval = 1000 / rate_hz;
    read_through(view, follow);
    return view;
  }

  // The board's variables have changed; the part is still, or again, among them.
  renew(tree: BoardTree, follow: Follow): void {
    const { variable, part } = tree.find(this.path)!;
    this.variable.monitored.delete(this);
    this.variable = variable;
    this.part = part;
    if (this.items === 0) return;
    variable.monitored.add(this);
    follow.want(variable);
  }

  withdraw(): void {
    put_value(this.node, unknown_node());
  }
}
