// SPDX-License-Identifier: Apache-2.0
// Bundles the page: node build.mjs [FOLDER]. File names contain a hash of their content, so that a browser may cache them
// without limit; only index.html has to be requested again.
import { mkdir, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { basename, join } from "node:path";
import { gzipSync } from "node:zlib";
import esbuild from "esbuild";

const max_size = 600_000;  // bytes, compressed, all files together
const folder = process.argv[2] ?? "dist";

await rm(folder, { recursive: true, force: true });
await mkdir(folder, { recursive: true });
const { metafile } = await esbuild.build({
  entryPoints: { page: "src/main.tsx" },
  outdir: folder,
  entryNames: "[name]-[hash]",
  chunkNames: "part-[hash]",
  bundle: true,
  splitting: true,
  format: "esm",
  target: ["es2022"],
  minify: true,
  legalComments: "linked",
  jsx: "automatic",
  jsxImportSource: "preact",
  metafile: true,
  logLevel: "warning",
});
const script = Object.entries(metafile.outputs).find(([, output]) => output.entryPoint === "src/main.tsx");
// Files that the start needs are requested at once, not when the file that imports them has arrived.
const needed = new Set();
const add_imports = (path) => {
  for (const { path: next, kind } of metafile.outputs[path].imports) {
    if (kind !== "import-statement" || needed.has(next)) continue;
    needed.add(next);
    add_imports(next);
  }
};
add_imports(script[0]);
const preloads = [...needed].map((path) => `  <link rel="modulepreload" href="${basename(path)}">\n`).join("");
const page = (await readFile("src/index.html", "utf8"))
  .replace("page.css", basename(script[1].cssBundle))
  .replace("page.js", basename(script[0]))
  .replace("</head>", `${preloads}</head>`);
await writeFile(join(folder, "index.html"), page);

let sum = 0;
for (const name of await readdir(folder)) {
  sum += gzipSync(await readFile(join(folder, name)), { level: 9 }).length;
}
console.log(`the page: ${Math.ceil(sum / 1000)} kB compressed, of ${max_size / 1000} kB allowed`);
if (sum > max_size) process.exit(1);
