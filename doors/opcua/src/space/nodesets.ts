// SPDX-License-Identifier: Apache-2.0
// Types of the standard and of companion specifications, which build.mjs puts into the program's folder.

import { fileURLToPath } from "node:url";

export function nodeset_file(name: string): string {
  return fileURLToPath(new URL(`../${name}.ndjson.gz`, import.meta.url));
}
