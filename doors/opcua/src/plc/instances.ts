// SPDX-License-Identifier: Apache-2.0
// The nodes of a board's programs: instances as objects, their variables, charts. A new program changes what has changed;
// all else stays as it is, and so do subscriptions. Nodes that are gone stay outside of the tree while a client monitors
// them, as those of the board's variables do.

import { AccessLevelFlag, type BaseNode, type NodeId, type UAObject, type UAObjectType, type UAVariable } from "node-opcua";

import { children_of, has_too_many_parts, type Part } from "../model/part";
import type { PlcInstance, PlcType, PlcVariable } from "../serve/types";
import { set_unsigned } from "../space/set";
import type { BoardTree, Space } from "../space/tree";
import type { Variable } from "../space/variable";
import { add_properties, Local, type Words } from "./local";
import type { PlcModel } from "./model";
import { CHART, is_shown, names_of } from "./pou_types";

const MOST_NODES = 50_000;  // of a board

interface Place {
  parent: BaseNode;
  reference: NodeId;  // from there
}

interface Entry extends Place {
  node: UAObject | UAVariable;
  shown: boolean;  // it has a place in the tree
  round: number;  // of the last update that has it
  local?: Local;
  declared?: string;  // of a variable: what its attributes and properties are made of
  links: { referenceType: NodeId; nodeId: NodeId }[];  // to nodes that are elsewhere
}

// A program whose nodes are made now.
export interface Making {
  types: PlcType[];
  nodes: UAObjectType[];  // of the types
  tree: BoardTree;
  variable: Variable;  // with its data
  priority: number;  // of its task
}

export class Instances {
  too_many = false;
  private readonly entries = new Map<string, Entry>();  // by id, each after the one that it is in
  private readonly locals = new Map<string, Local>();  // by the text of the node id
  private readonly withdrawn = new Map<string, Entry>();  // those without a place in the tree
  private round = 0;

  constructor(private readonly space: Space, private readonly model: PlcModel) {}

  get size(): number {
    return this.entries.size;
  }

  find(node: string): Local | undefined {
    return this.locals.get(node);
  }

  begin(): void {
    this.round++;
    this.too_many = false;
  }

  // An instance of a program, which `task` executes.
  program(id: string, { name, type, offset }: PlcInstance, making: Making, parent: UAObject, task: UAObject): void {
    const place = { parent, reference: this.part_of() };
    this.instance(id, name, type, offset, making, place, [{ referenceType: this.model.reference("With"), nodeId: task.nodeId }]);
  }

  // Removes what the programs since begin() do not have.
  end(): void {
    for (const [id, entry] of [...this.entries].reverse()) {
      if (entry.round !== this.round) this.remove(id, entry);
    }
  }

  // Removes what no client monitors any more.
  sweep(): void {
    for (const [id, entry] of this.withdrawn) this.remove(id, entry);
  }

  private part_of(): NodeId {
    return this.space.address_space.findReferenceType("HasComponent")!.nodeId;
  }

  private instance(id: string, name: string, type: number, offset: number, making: Making, place: Place, links: Entry["links"] = []): void {
    const entry = this.object(id, name, making.nodes[type], place);
    if (!entry) return;
    this.unlink(entry);
    const bases: PlcType[] = [];
    for (let at: number | undefined = type; at !== undefined; at = making.types[at].base) bases.unshift(making.types[at]);
    for (const variable of bases.flatMap(({ variables }) => variables)) {
      if (variable.variable !== undefined) {
        const node = making.tree.node_of(variable.variable);
        if (node) links.push({ referenceType: this.model.section(variable.section), nodeId: node.nodeId });
      } else if (is_shown(variable)) {
        this.member(id, variable, offset, making, entry.node as UAObject);
      }
    }
    for (const link of links) {
      if (entry.links.some(({ referenceType, nodeId }) => `${referenceType}${nodeId}` === `${link.referenceType}${link.nodeId}`)) continue;
      entry.node.addReference(link);
      entry.links.push(link);
    }
  }

  private member(owner: string, variable: PlcVariable, begin: number, making: Making, node: UAObject): void {
    const { name, section, type: form, offset, description, step } = variable;
    const place = { parent: node as BaseNode, reference: this.model.section(section) };
    if (form.kind === "instance") {
      names_of(name, form).forEach((each, i) => {
        this.instance(`${owner}.${each}`, each, form.instance!, begin + offset! + i * form.size, making, place);
      });
      return;
    }
    if (step) {
      const chart = this.chart(owner, node, making.priority);
      if (!chart) return;
      place.parent = chart;
      place.reference = this.part_of();
    }
    const part: Part = {
      path: `${owner}.${name}`, label: name, form, offset: begin + (offset ?? 0), unit: "", range: null, description: description ?? "", children: [],
    };
    if (!has_too_many_parts(form)) part.children = children_of(part);
    this.value(part, offset !== undefined, making.variable, place, variable);
  }

  private chart(owner: string, node: UAObject, priority: number): BaseNode | undefined {
    const id = `${owner}/${CHART}`;
    const before = this.entries.get(id);
    if (before?.round === this.round) return before.node;
    const entry = this.object(id, CHART, this.model.type("SFCType"), { parent: node, reference: this.part_of() });
    if (!entry) return undefined;
    if (entry !== before) {
      this.space.namespace.addVariable({
        propertyOf: entry.node, browseName: { name: "Priority", namespaceIndex: this.model.index }, nodeId: `s=${id}/Priority`, dataType: "UInt32",
      });
    }
    set_unsigned(entry.node, "Priority", priority);
    return entry.node;
  }

  private object(id: string, name: string, type: UAObjectType, place: Place): Entry | undefined {
    const known = this.entries.get(id);
    if (!known) {
      return this.keep(id, place, () => this.space.namespace.addObject({
        browseName: name, nodeId: `s=${id}`, typeDefinition: type, references: [this.below(place)],
      }));
    }
    const object = known.node as UAObject;
    if (`${object.typeDefinition}` !== `${type.nodeId}`) {
      object.removeReference({ referenceType: "HasTypeDefinition", nodeId: object.typeDefinition });
      object.addReference({ referenceType: "HasTypeDefinition", nodeId: type.nodeId });
    }
    this.attach(id, known, place);
    return known;
  }

  private value(part: Part, has_value: boolean, variable: Variable, place: Place, words: Words): void {
    const declared = JSON.stringify([part.form, part.description, words.retain, words.non_retain]);
    const known = this.entries.get(part.path);
    const fits = (known?.local !== undefined) === has_value && (has_value || known?.declared === declared);
    if (known && !fits) this.discard_all(part.path, known);
    let entry = this.entries.get(part.path);
    if (entry) {
      entry.local?.move(part, variable);
      this.attach(part.path, entry, place);
      if (entry.declared !== declared) this.declare_again(entry.node as UAVariable, part, words);
      entry.declared = declared;
    } else {
      entry = this.keep(part.path, place, () => this.make(part, has_value, place, words));
      if (!entry) return;
      entry.declared = declared;
      if (has_value) {
        entry.local = new Local(entry.node as UAVariable, part, variable, this.space);
        this.locals.set(entry.node.nodeId.toString(), entry.local);
      }
    }
    for (const child of part.children) this.value(child, has_value, variable, { parent: entry.node, reference: this.part_of() }, {});
  }

  private make(part: Part, has_value: boolean, place: Place, words: Words): UAVariable {
    const dims = part.form.dims ?? [];
    const access = has_value ? AccessLevelFlag.CurrentRead : 0;
    const node = this.space.namespace.addVariable({
      references: [this.below(place)], browseName: part.label, nodeId: `s=${part.path}`, description: part.description, dataType: this.space.types.of(part.form),
      valueRank: dims.length || -1, arrayDimensions: dims.length ? dims : undefined, accessLevel: access, userAccessLevel: access,
      minimumSamplingInterval: 1000 / this.space.rate_hz,
    } as any);
    add_properties(this.space, node, part.form, words, this.model.index);
    return node;
  }

  private declare_again(node: UAVariable, part: Part, words: Words): void {
    (node as any).description = { text: part.description };
    for (const property of node.getProperties()) this.space.namespace.deleteNode(property);
    add_properties(this.space, node, part.form, words, this.model.index);
  }

  private keep(id: string, place: Place, make: () => Entry["node"]): Entry | undefined {
    if (this.entries.size >= MOST_NODES) {
      this.too_many = true;
      return undefined;
    }
    const entry: Entry = { ...place, node: make(), shown: true, round: this.round, links: [] };
    this.entries.set(id, entry);
    return entry;
  }

  private below({ parent, reference }: Place): { referenceType: NodeId; isForward: boolean; nodeId: NodeId } {
    return { referenceType: reference, isForward: false, nodeId: parent.nodeId };
  }

  private attach(id: string, entry: Entry, place: Place): void {
    entry.round = this.round;
    const same = entry.parent === place.parent && `${entry.reference}` === `${place.reference}`;
    if (entry.shown && same) return;
    if (entry.shown) this.detach(entry);
    entry.node.addReference(this.below(place));
    Object.assign(entry, place, { shown: true });
    this.withdrawn.delete(id);
  }

  private detach(entry: Entry): void {
    entry.node.removeReference(this.below(entry));
    entry.shown = false;
  }

  // Links to nodes that are gone have gone with them.
  private unlink({ node, links }: Entry): void {
    for (const link of links.splice(0)) {
      if (this.space.address_space.findNode(link.nodeId)) node.removeReference(link);
    }
  }

  private remove(id: string, entry: Entry): void {
    if (entry.local && entry.local.items > 0) {
      if (!entry.shown) return;
      this.detach(entry);
      this.withdrawn.set(id, entry);
      entry.local.withdraw();
      return;
    }
    this.discard(id, entry);
  }

  private discard_all(id: string, entry: Entry): void {
    for (const [inner_id, inner] of [...this.entries]) if (inner.parent === entry.node) this.discard_all(inner_id, inner);
    this.discard(id, entry);
  }

  // Without its links: the nodes there would be deleted, too.
  private discard(id: string, entry: Entry): void {
    this.unlink(entry);
    if (entry.local) {
      entry.local.variable.monitored.delete(entry.local);
      this.locals.delete(entry.node.nodeId.toString());
    }
    this.entries.delete(id);
    this.withdrawn.delete(id);
    this.space.namespace.deleteNode(entry.node);
  }
}
