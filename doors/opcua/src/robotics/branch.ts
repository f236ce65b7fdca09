// SPDX-License-Identifier: Apache-2.0
// An object of the model that comes and goes with what it stands for. One that has gone has no place in the tree; if it
// returns it is the same node, so that subscriptions to its variables continue.

import type { BaseNode, UAObject } from "node-opcua";

import type { BoardTree, Space } from "../space/tree";
import type { Derive } from "../space/variable";
import { node_at } from "../space/set";
import type { Model, Place } from "./model";
import { View } from "./view";

export interface Shared {
  model: Model;
  space: Space;
  views: Map<string, View>;  // of all boards, by the text of the node id
}

interface Link {
  from: UAObject;
  type: string;
  to: UAObject;
}

export class Branch {
  readonly node: UAObject;
  private readonly parent: BaseNode;
  private readonly views: View[] = [];
  private readonly links: Link[] = [];
  private shown = true;

  constructor(private readonly shared: Shared, type: string, place: Place) {
    this.node = shared.model.add(type, place);
    this.parent = place.parent;
  }

  // The variable at `at` has the value of a part of the board.
  view(tree: BoardTree, at: string, path: string, derive?: Derive): void {
    const view = View.make(node_at(this.node, at), tree, path, this.shared.space, derive);
    this.views.push(view);
    this.shared.views.set(view.node.nodeId.toString(), view);
  }

  link(from: UAObject, type: string, to: UAObject): void {
    this.shared.model.link(from, type, to);
    this.links.push({ from, type, to });
  }

  renew(tree: BoardTree): void {
    for (const view of this.views) view.renew(tree, this.shared.space.follow);
    if (this.shown) return;
    this.shown = true;
    this.node.addReference({ referenceType: "HasComponent", isForward: false, nodeId: this.parent.nodeId });
    for (const { from, type, to } of this.links) this.shared.model.link(from, type, to);
  }

  withdraw(): void {
    if (!this.shown) return;
    this.shown = false;
    this.node.removeReference({ referenceType: "HasComponent", isForward: false, nodeId: this.parent.nodeId });
    for (const { from, type, to } of this.links) this.shared.model.unlink(from, type, to);
    for (const view of this.views) view.withdraw();
  }
}
