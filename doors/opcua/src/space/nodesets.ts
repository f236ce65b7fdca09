// SPDX-License-Identifier: Apache-2.0
// Types of the standard and of companion specifications, which build.mjs puts into the program's folder.

import { fileURLToPath } from "node:url";

import type { AddressSpace } from "node-opcua";
import { generateAddressSpace } from "node-opcua-address-space/nodeJS";

const loading = new WeakMap<AddressSpace, { files: Set<string>; last: Promise<void> }>();

export function nodeset_file(name: string): string {
  return fileURLToPath(new URL(`../${name}.ndjson.gz`, import.meta.url));
}

// Loads those that are not there yet: models share DI. One after the other, since a file requires those before it.
export function load_nodesets(space: AddressSpace, names: string[]): Promise<void> {
  const state = loading.get(space) ?? { files: new Set<string>(), last: Promise.resolve() };
  loading.set(space, state);
  const missing = names.filter((name) => !state.files.has(name));
  for (const name of missing) state.files.add(name);
  if (missing.length > 0) state.last = state.last.then(() => generateAddressSpace(space, missing.map(nodeset_file)));
  return state.last;
}
