// SPDX-License-Identifier: Apache-2.0
// The nodes of one board: a folder, folders for the namespaces of its variables, variables, their parts. A new list of
// variables changes what has changed; all else stays as it is, and so do subscriptions.

import { AccessLevelFlag, DataType, Range as EuRange, StatusCodes, type AddressSpace, type Namespace, type NodeId, type UAObject, type UAVariable } from "node-opcua";

import { has_too_many_parts, part_of, parts_below, type Part } from "../model/part";
import { unit_of } from "../model/units";
import type { VariableDescription } from "../serve/types";
import type { Follow } from "./follow";
import { put_value, type HistoryRead, type InnerVariable, type WriteAttribute } from "./internals";
import { read_through } from "./read";
import type { Types } from "./types";
import { unknown_node, Variable, type PartNode } from "./variable";

export interface Space {
  address_space: AddressSpace;
  namespace: Namespace;
  types: Types;
  follow: Follow;
  by_node: Map<string, PartNode>;  // by the text of the node id
  rate_hz: number;
  writable: boolean;
  write: WriteAttribute;
  read_history: HistoryRead;
}

// What can still not be shown as it is, for people.
export function notes_of(variables: VariableDescription[]): string[] {
  return variables.filter(({ form }) => has_too_many_parts(form)).map(
    ({ name }) => `${name}: it has more than 2000 parts: they have no nodes of their own, the variable has`);
}

function same_type(a: Part, b: Part): boolean {
  return JSON.stringify(a.form) === JSON.stringify(b.form);
}

function same_properties(a: Part, b: Part): boolean {
  return a.unit === b.unit && JSON.stringify(a.range) === JSON.stringify(b.range) && a.description === b.description;
}

export class BoardTree {
  layout = "";
  private has_history = false;
  readonly folder: UAObject;
  private readonly variables = new Map<string, Variable>();
  private readonly folders = new Map<string, UAObject>();

  constructor(readonly board: string, private readonly space: Space) {
    this.folder = space.namespace.addFolder(space.address_space.rootFolder.objects, {
      browseName: board, nodeId: `s=${board}`, eventNotifier: 1, nodeVersion: "1",
    } as any);
    this.folder.addReference({ referenceType: "HasEventSource", isForward: false, nodeId: space.address_space.rootFolder.objects.server });
  }

  variable(name: string): Variable | undefined {
    return this.variables.get(name);
  }

  // The variable of a part, and the part.
  find(path: string): { variable: Variable; part: Part } | undefined {
    const variable = this.variables.get(/^(?:.*::)?\w+/.exec(path)?.[0] ?? "");
    if (!variable || variable.gone) return undefined;
    for (const part of parts_below(variable.part)) if (part.path === path) return { variable, part };
    return undefined;
  }

  node_of(path: string): UAVariable | undefined {
    return this.space.by_node.get(this.id_text(path))?.node;
  }

  // has_history: the board is on the server's own host.
  async update(list: VariableDescription[], layout: string, has_history: boolean): Promise<void> {
    this.has_history = has_history;
    const parts = new Map(list.map((one) => [one.name, part_of(one)]));
    for (const part of parts.values()) for (const one of parts_below(part)) this.space.types.of(one.form);
    await this.space.types.register();
    this.space.address_space.modelChangeTransaction(() => {
      for (const variable of this.variables.values()) {
        if (!parts.has(variable.part.path)) this.withdraw(variable);
      }
      for (const part of parts.values()) this.place(part);
    });
    this.layout = layout;
    this.set_taped(list);
  }

  // Whether the tape of the node has them may differ after each of its starts.
  set_taped(list: VariableDescription[]): void {
    for (const { name, taped } of list) {
      const variable = this.variables.get(name);
      if (!variable) continue;
      variable.taped = taped ?? false;
      for (const { node } of variable.parts.values()) node.minimumSamplingInterval = variable.taped ? 0 : 1000 / this.space.rate_hz;
    }
  }

  // Nodes of variables that are gone stay, without a place in the tree, while a client monitors them: they come back if a
  // later deployment has them again.
  sweep(): void {
    for (const [name, variable] of this.variables) {
      for (const one of [...variable.parts.values()]) {
        if (one.items === 0 && (variable.gone || !this.has_part(variable, one.part.path))) this.remove(variable, one);
      }
      if (variable.gone && variable.parts.size === 0) this.variables.delete(name);
    }
  }

  private id_text(path: string): string {
    return `ns=${this.space.namespace.index};s=${this.board}/${path}`;
  }

  private has_part(variable: Variable, path: string): boolean {
    for (const part of parts_below(variable.part)) if (part.path === path) return true;
    return false;
  }

  private withdraw(variable: Variable): void {
    if (variable.gone) return;
    variable.gone = true;
    this.space.follow.drop(variable);
    for (const one of [...variable.parts.values()].reverse()) this.withdraw_part(variable, one);
    variable.wake();
  }

  private withdraw_part(variable: Variable, one: PartNode): void {
    if (one.items === 0) {
      this.remove(variable, one);
      return;
    }
    if (one.shown) one.node.removeReference({ referenceType: "HasComponent", isForward: false, nodeId: one.parent.nodeId });
    one.shown = false;
    put_value(one.node, unknown_node());
  }

  private remove(variable: Variable, one: PartNode): void {
    variable.parts.delete(one.part.path);
    this.space.by_node.delete(one.node.nodeId.toString());
    this.space.namespace.deleteNode(one.node);
  }

  private place(part: Part): void {
    let variable = this.variables.get(part.path);
    if (!variable) {
      variable = new Variable(this.board, part, this.space.types.construct);
      this.variables.set(part.path, variable);
    }
    variable.gone = false;
    const old = variable.part;
    variable.part = part;
    if (!same_type(old, part)) variable.lose(StatusCodes.BadWaitingForInitialData);
    const paths = new Set([...parts_below(part)].map(({ path }) => path));
    for (const one of [...variable.parts.values()].reverse()) {
      if (!paths.has(one.part.path)) this.withdraw_part(variable, one);
    }
    this.place_part(variable, part, this.folder_of(part.path));
    if (variable.monitored.size > 0) this.space.follow.want(variable);
  }

  private place_part(variable: Variable, part: Part, parent: UAObject | UAVariable): void {
    const known = variable.parts.get(part.path);
    const node = known ? this.change_node(known, part, parent) : this.add_node(variable, part, parent);
    for (const child of part.children) this.place_part(variable, child, node);
  }

  private add_node(variable: Variable, part: Part, parent: UAObject | UAVariable): UAVariable {
    const { namespace, types, by_node, write, read_history, rate_hz, writable } = this.space;
    const dims = part.form.dims ?? [];
    const access = AccessLevelFlag.CurrentRead | (writable ? AccessLevelFlag.CurrentWrite : 0) | (this.has_history ? AccessLevelFlag.HistoryRead : 0);
    const node = namespace.addVariable({
      componentOf: parent,
      browseName: part.label,
      nodeId: this.id_text(part.path),
      description: part.description,
      dataType: types.of(part.form),
      valueRank: dims.length || -1,
      arrayDimensions: dims.length ? dims : undefined,
      accessLevel: access,
      userAccessLevel: access,
      historizing: this.has_history,
      minimumSamplingInterval: 1000 / rate_hz,
      typeDefinition: part.range ? "AnalogItemType" : part.unit ? "AnalogUnitType" : "BaseDataVariableType",
    } as any) as unknown as InnerVariable;
    const one: PartNode = { part, node, variable, items: 0, parent, shown: true };
    node.writeAttribute = write;
    node._historyRead = read_history;
    read_through(one, this.space.follow);
    variable.parts.set(part.path, one);
    by_node.set(node.nodeId.toString(), one);
    this.add_properties(node, part);
    return node;
  }

  private add_properties(node: UAVariable, part: Part): void {
    const add = (name: string, dataType: string, value: object): void => {
      this.space.namespace.addVariable({
        propertyOf: node, browseName: { name, namespaceIndex: 0 }, nodeId: `${node.nodeId.toString()}/${name}`, dataType,
        value: { dataType: DataType.ExtensionObject, value } as any,
      });
    };
    if (part.unit) add("EngineeringUnits", "EUInformation", unit_of(part.unit));
    if (part.range) {
      add("EURange", "Range", new EuRange({
        low: part.range.min ?? -Number.MAX_VALUE, high: part.range.max ?? Number.MAX_VALUE,
      }));
    }
  }

  private change_node(known: PartNode, part: Part, parent: UAObject | UAVariable): UAVariable {
    const { node } = known;
    const before = known.part;
    known.part = part;
    if (!known.shown) node.addReference({ referenceType: "HasComponent", isForward: false, nodeId: parent.nodeId });
    known.shown = true;
    known.parent = parent;
    if (!same_type(before, part)) {
      const dims = part.form.dims ?? [];
      node.dataType = this.space.types.of(part.form) as NodeId;
      node.valueRank = dims.length || -1;
      (node as any).arrayDimensions = dims.length ? dims : null;
      node._basicDataType = undefined;
    }
    if (!same_properties(before, part)) {
      for (const name of ["EngineeringUnits", "EURange"]) {
        const property = node.getPropertyByName(name);
        if (property) this.space.namespace.deleteNode(property);
      }
      this.add_properties(node, part);
      (node as any).description = { text: part.description };
    }
    return node;
  }

  // The folder of the namespace of a full name.
  folder_of(path: string): UAObject {
    const at = path.lastIndexOf("::");
    if (at < 0) return this.folder;
    const name = path.slice(0, at);
    let folder = this.folders.get(name);
    if (!folder) {
      folder = this.space.namespace.addFolder(this.folder_of(name), {
        browseName: name.slice(name.lastIndexOf(":") + 1), nodeId: this.id_text(name),
      });
      this.folders.set(name, folder);
    }
    return folder;
  }
}
