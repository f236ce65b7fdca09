// SPDX-License-Identifier: Apache-2.0
// Data types of enumerations and structures. A type that has changed is another node: its id ends in a digest of its form,
// so clients that remember a description never apply it to other bytes.

import { createHash } from "node:crypto";

import { DataType, type AddressSpace, type ExtensionObject, type Namespace, type NodeId, type UADataType } from "node-opcua";
import { ensureDatatypeExtracted, PseudoSession } from "node-opcua-address-space";
import { DataTypeExtractStrategy, populateDataTypeManager, type ExtraDataTypeManager } from "node-opcua-client-dynamic-extension-object";

import { built_in, key_of } from "../model/values";
import { elements_of } from "../model/part";
import type { Field, Form } from "../serve/types";

const DIGEST_LENGTH = 8;

function signature(form: Form): string {
  const { dims: _, low: __, range: ___, ...element } = form;
  return JSON.stringify(element);
}

export class Types {
  private readonly known = new Map<string, UADataType>();  // by signature
  private readonly nodes = new WeakMap<object, UADataType>();  // by form, which is seen many times
  private unregistered = false;
  // What a structure cannot show as it is, for people.
  readonly notes = new Set<string>();
  // Types of their own for elementary types of IEC 61131-3, once a PLC program is shown.
  of_iec: (iec: string) => NodeId | undefined = () => undefined;

  constructor(private readonly space: AddressSpace, private readonly namespace: Namespace) {}

  // The type's node; it is made if necessary. Before values of new structures are made: register().
  of(form: Form): NodeId {
    const of_iec = form.iec ? this.of_iec(form.iec) : undefined;
    if (of_iec) return of_iec;
    return form.kind === "struct" || form.kind === "enum" ? this.node(form).nodeId : this.space.findDataType(built_in(form))!.nodeId;
  }

  // Makes new structures known to the encoder.
  async register(): Promise<void> {
    if (!this.unregistered) return;
    this.unregistered = false;
    const manager = await ensureDatatypeExtracted(this.space) as ExtraDataTypeManager;
    await populateDataTypeManager(new PseudoSession(this.space), manager, DataTypeExtractStrategy.Force104);
  }

  construct = (form: Form, fields: Record<string, unknown>): ExtensionObject =>
    this.space.constructExtensionObject(this.node(form), fields);

  private node(form: Form): UADataType {
    const seen = this.nodes.get(form);
    if (seen) return seen;
    const key = signature(form);
    let node = this.known.get(key);
    if (!node) {
      const id = `${form.name}#${createHash("sha256").update(key).digest("hex").slice(0, DIGEST_LENGTH)}`;
      node = form.kind === "enum" ? this.make_enumeration(form, id) : this.make_structure(form, id);
      this.known.set(key, node);
    }
    this.nodes.set(form, node);
    return node;
  }

  private make_enumeration(form: Form, id: string): UADataType {
    const node = this.namespace.createDataType({
      browseName: form.name ?? id,
      nodeId: `s=type/${id}`,
      subtypeOf: "Enumeration",
      isAbstract: false,
      partialDefinition: Object.entries(form.enumerators ?? {}).map(([name, value]) => ({ name, value })),
    } as any);
    this.namespace.addVariable({
      browseName: { name: "EnumValues", namespaceIndex: 0 },
      nodeId: `s=type/${id}/EnumValues`,
      propertyOf: node,
      dataType: "EnumValueType",
      valueRank: 1,
      value: {
        dataType: DataType.ExtensionObject,
        value: Object.entries(form.enumerators ?? {}).map(([name, value]) => this.space.constructExtensionObject(
          this.space.findDataType("EnumValueType")!, { value: [value < 0 ? 0xffffffff : 0, value >>> 0], displayName: { text: name } })),
      } as any,
    });
    return node;
  }

  private make_structure(form: Form, id: string): UADataType {
    const fields = form.fields ?? [];
    const keys = new Set(fields.map(key_of));
    if (keys.size !== fields.length) {
      this.notes.add(`${form.name}: names of fields differ in their first letter's case only: one of them is missing in values of the whole structure`);
    }
    const node = this.namespace.createDataType({
      browseName: form.name ?? id,
      nodeId: `s=type/${id}`,
      subtypeOf: "Structure",
      isAbstract: false,
      partialDefinition: fields.map((field) => this.definition_of(form, field)),
    } as any);
    this.namespace.addObject({
      browseName: { name: "Default Binary", namespaceIndex: 0 },
      nodeId: `s=type/${id}/binary`,
      encodingOf: node,
      typeDefinition: "DataTypeEncodingType",
    });
    this.unregistered = true;
    return node;
  }

  // Arrays of several dimensions inside of a structure are one list there: node-opcua encodes no others.
  private definition_of(form: Form, field: Field): object {
    const dims = field.type.dims ?? [];
    if (dims.length > 1) {
      this.notes.add(`${form.name}.${field.name}: ${dims.length} dimensions; in values of the whole structure they are one list, the last index fastest`);
    }
    return {
      name: field.name,
      description: { text: field.description ?? "" },
      dataType: this.of(field.type),
      valueRank: dims.length ? 1 : -1,
      arrayDimensions: dims.length ? [elements_of(field.type)] : undefined,
    };
  }
}
