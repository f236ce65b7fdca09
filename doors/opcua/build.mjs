// SPDX-License-Identifier: Apache-2.0
// Bundles the program: node build.mjs [FOLDER]. The folder then holds all that Node.js 18 needs: the program, the types
// that the standard and companion specifications define, the licences of the packages, and the manual page.
import { execFileSync } from "node:child_process";
import { chmod, copyFile, mkdir, readFile, rm, writeFile } from "node:fs/promises";
import { join } from "node:path";
import esbuild from "esbuild";
import { man_page } from "./src/man_page.mjs";

const folder = process.argv[2] ?? "dist";
const program = join(folder, "bin/indurop-opcua.mjs");
const { version } = JSON.parse(await readFile("package.json", "utf8"));

// node-opcua asks for Node.js 22. What it uses of it and Debian 12's Node.js 18 lacks is stated here.
const prologue = `#!/usr/bin/env node
import { createRequire as create_require_ } from "node:module";
import { webcrypto as webcrypto_ } from "node:crypto";
import { fileURLToPath as path_of_ } from "node:url";
import { dirname as folder_of_ } from "node:path";
const require = create_require_(import.meta.url);
const __filename = path_of_(import.meta.url);
const __dirname = folder_of_(__filename);
globalThis.crypto ??= webcrypto_;`;

await rm(folder, { recursive: true, force: true });
await mkdir(join(folder, "bin"), { recursive: true });
await esbuild.build({
  entryPoints: ["src/main.ts"],
  outfile: program,
  bundle: true,
  platform: "node",
  format: "esm",
  target: ["node18"],
  minify: true,
  lineLimit: 200,  // of a line that is printed when something fails
  keepNames: true,
  legalComments: "linked",
  banner: { js: prologue },
  define: {
    "import.meta.dirname": "__dirname",
    "import.meta.filename": "__filename",
    INDUROP_VERSION: JSON.stringify(version),
  },
  external: ["proper-lockfile", "bufferutil", "utf-8-validate"],  // optional, not installed
  logLevel: "warning",
});
await chmod(program, 0o755);
// The standard, and what src/robotics/model.ts loads; of the OPC Foundation, under its MIT licence.
for (const name of ["Opc.Ua.NodeSet2", "Opc.Ua.Di.NodeSet2", "Opc.Ua.IA.NodeSet2", "Opc.Ua.Robotics.NodeSet2"]) {
  const file = `${name}.ndjson.gz`;
  await copyFile(join("node_modules/node-opcua-nodesets/nodesets", file), join(folder, file));
}
// node-opcua reads one in the folder above its files.
await writeFile(join(folder, "package.json"), `${JSON.stringify({ name: "indurop-opcua", version })}\n`);
const help = execFileSync(process.execPath, [program, "--help"], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
await writeFile(join(folder, "indurop-opcua.1"), man_page("indurop-opcua", help));
