// SPDX-License-Identifier: Apache-2.0
// A local variable of a program, or a part of one: a place in the data that the program reports.

import { DataType, type AddressSpace, type NodeId, type UAVariable } from "node-opcua";

import type { Part } from "../model/part";
import type { Form } from "../serve/types";
import { put_value, type InnerVariable } from "../space/internals";
import { read_through } from "../space/read";
import type { Space } from "../space/tree";
import { unknown_node, type Variable, type Watched } from "../space/variable";

export interface Words {
  retain?: boolean;
  non_retain?: boolean;
}

export class Local implements Watched {
  readonly node: InnerVariable;
  readonly marked = true;
  items = 0;

  constructor(node: UAVariable, public part: Part, public variable: Variable, private readonly space: Space) {
    this.node = node as InnerVariable;
    read_through(this, space.follow);
  }

  // Another program may have it at another place, or with another type.
  move(part: Part, variable: Variable): void {
    const same = JSON.stringify(this.part.form) === JSON.stringify(part.form);
    this.part = part;
    if (!same) {
      const dims = part.form.dims ?? [];
      this.node.dataType = this.space.types.of(part.form);
      this.node.valueRank = dims.length || -1;
      (this.node as any).arrayDimensions = dims.length ? dims : null;
      this.node._basicDataType = undefined;
    }
    if (variable !== this.variable) {
      this.variable.monitored.delete(this);
      this.variable = variable;
    }
    if (this.items === 0) return;
    variable.monitored.add(this);
    this.space.follow.want(variable);
    put_value(this.node, variable.value_for(this));
  }

  withdraw(): void {
    this.variable.monitored.delete(this);
    put_value(this.node, unknown_node());
  }
}

// What OPC 30000 demands of arrays and subranges, and the keywords of the declaration. `standard`: namespace of their names.
export function add_properties(space: Space, node: UAVariable, { dims, low, range, kind }: Form, { retain, non_retain }: Words, standard: number): void {
  const add = (name: string, dataType: DataType, value: unknown, rank = -1): void => {
    space.namespace.addVariable({
      propertyOf: node, browseName: { name, namespaceIndex: standard }, nodeId: `${node.nodeId.toString()}/${name}`, dataType: DataType[dataType],
      valueRank: rank, arrayDimensions: rank === 1 ? [(value as number[]).length] : undefined,
      value: { dataType, arrayType: rank === 1 ? 1 : 0, value } as any,
    });
  };
  if (dims && low) {
    add("Dimensions", DataType.UInt32, dims.length);
    add("IndexMin", DataType.Int32, low, 1);
    add("IndexMax", DataType.Int32, dims.map((count, i) => low[i] + count - 1), 1);
  }
  if (range) {
    const type = kind === "u64" || kind === "i64" ? DataType.Double : basic_type(space.address_space, space.types.of({ kind, size: 0 }));
    add("SubrangeMin", type, range.min);
    add("SubrangeMax", type, range.max);
  }
  if (retain) add("RETAIN", DataType.Boolean, true);
  if (non_retain) add("NON_RETAIN", DataType.Boolean, true);
}

function basic_type(space: AddressSpace, id: NodeId): DataType {
  return space.findDataType(id)!.basicDataType;
}
