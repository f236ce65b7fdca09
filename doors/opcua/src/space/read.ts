// SPDX-License-Identifier: Apache-2.0
// What a client reads: a variable that was not received yet is requested first.

import type { DataValue, UAVariable } from "node-opcua";

import type { Follow } from "./follow";
import { unknown_node, type Watched } from "./variable";

// What the function of a node needs; it is the same for all nodes.
const inner = new WeakMap<UAVariable, { one: Watched; follow: Follow }>();

export function read_through(one: Watched, follow: Follow): void {
  inner.set(one.node, { one, follow });
  one.node.refreshFunc = refresh;
}

function refresh(this: UAVariable, done: (error: Error | null, value: DataValue) => void): void {
  const { one, follow } = inner.get(this)!;
  const { variable } = one;
  follow.when_known(variable, () => {
    one.node.$dataValue = variable.gone ? unknown_node() : variable.value_for(one);
    done(null, one.node.$dataValue);
  });
}
