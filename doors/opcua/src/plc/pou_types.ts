// SPDX-License-Identifier: Apache-2.0
// The types of programs and function blocks. A type that has changed is another node: its id ends in a digest of its
// declaration, as those of data types do.

import { createHash } from "node:crypto";

import type { BaseNode, Namespace, NodeId, UAObjectType } from "node-opcua";

import { index_text, elements_of } from "../model/part";
import type { Form, PlcType, PlcVariable } from "../serve/types";
import type { Types } from "../space/types";
import type { PlcModel } from "./model";

const DIGEST_LENGTH = 8;
const TYPE_IDS = "type/plc/";

export const CHART = "SFC";

// Variables that have a node of their own: those with a value, and parameters by reference, whose values are elsewhere.
export function is_shown({ variable, type, offset, section }: PlcVariable): boolean {
  return variable === undefined && type.kind !== "reference" && (offset !== undefined || (section === "in_out" && type.kind !== "instance"));
}

// Names of the elements of an array of instances, or the name of the only one.
export function names_of(name: string, form: Form): string[] {
  return form.dims?.length ? Array.from({ length: elements_of(form) }, (_, i) => name + index_text(form, i)) : [name];
}

// With the digests of types that it contains instead of their numbers.
function declaration_of(form: Form, digests: string[]): object {
  const { instance, size: _, fields, ...rest } = form;
  return {
    ...rest, instance: instance === undefined ? undefined : digests[instance],
    fields: fields?.map(({ name, type }) => [name, declaration_of(type, digests)]),
  };
}

export class PouTypes {
  private readonly known = new Map<string, UAObjectType>();  // by id

  constructor(private readonly model: PlcModel, private readonly namespace: Namespace, private readonly data_types: Types) {}

  // Makes the data types that values of these types have; the caller registers them.
  prepare(types: PlcType[]): void {
    for (const variable of types.flatMap(({ variables }) => variables)) {
      if (is_shown(variable) && variable.type.kind !== "instance") this.data_types.of(variable.type);
    }
  }

  // The nodes of these types, in their order.
  all(types: PlcType[]): UAObjectType[] {
    const digests: string[] = [];
    const nodes: UAObjectType[] = [];
    for (const type of types) {
      const shown = type.variables.filter(is_shown);
      const text = JSON.stringify([type.name, type.kind, type.base === undefined ? "" : digests[type.base],
        shown.map(({ name, section, type: form, step }) => [name, section, step ?? false, declaration_of(form, digests)])]);
      const digest = createHash("sha256").update(text).digest("hex").slice(0, DIGEST_LENGTH);
      digests.push(digest);
      nodes.push(this.type(`${TYPE_IDS}${type.name}#${digest}`, type, shown, nodes));
    }
    return nodes;
  }

  private type(id: string, { name, kind, base }: PlcType, shown: PlcVariable[], others: UAObjectType[]): UAObjectType {
    const known = this.known.get(id);
    if (known) return known;
    const supertype = base === undefined ? this.model.type(kind === "program" ? "CtrlProgramType" : "CtrlFunctionBlockType") : others[base];
    // Names of types are unique in a namespace.
    const taken = this.model.has_type(name, this.namespace);
    const node = this.namespace.addObjectType({
      browseName: taken ? id.slice(TYPE_IDS.length) : name, displayName: name, nodeId: `s=${id}`, subtypeOf: supertype,
    });
    this.model.catalogue.addReference({ referenceType: "Organizes", nodeId: node.nodeId });
    let chart: BaseNode | undefined;
    for (const variable of shown) {
      if (variable.step) chart ??= this.chart(id, node);
      if (variable.type.kind === "instance") this.declare_instances(id, variable, others[variable.type.instance!], node);
      else this.declare_value(id, variable, variable.step ? chart! : node);
    }
    this.known.set(id, node);
    return node;
  }

  private chart(id: string, owner: UAObjectType): BaseNode {
    return this.namespace.addObject({
      browseName: CHART, nodeId: `s=${id}/${CHART}`, componentOf: owner, typeDefinition: this.model.type("SFCType"), modellingRule: "Mandatory",
    });
  }

  private declare_instances(id: string, { name, section, type }: PlcVariable, of: UAObjectType, owner: UAObjectType): void {
    for (const browseName of names_of(name, type)) {
      this.namespace.addObject({
        browseName, nodeId: `s=${id}/${browseName}`, typeDefinition: of, modellingRule: "Mandatory", references: [this.below(owner, this.model.section(section))],
      });
    }
  }

  private declare_value(id: string, { name, section, type, step }: PlcVariable, owner: BaseNode): void {
    const dims = type.dims ?? [];
    this.namespace.addVariable({
      browseName: name, nodeId: `s=${id}/${name}`, modellingRule: "Mandatory", dataType: this.data_types.of(type), valueRank: dims.length || -1,
      arrayDimensions: dims.length ? dims : undefined, ...(step ? { componentOf: owner } : { references: [this.below(owner, this.model.section(section))] }),
    } as any);
  }

  private below(owner: BaseNode, referenceType: NodeId): { referenceType: NodeId; isForward: boolean; nodeId: NodeId } {
    return { referenceType, isForward: false, nodeId: owner.nodeId };
  }
}
