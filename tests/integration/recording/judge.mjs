// SPDX-License-Identifier: Apache-2.0
// judge.mjs PACKAGES FOLDER: reads the recordings in FOLDER with the packages of others and compares each value with
// expected.jsonl; then writes recordings of its own there, foreign_*.mcap, and what is in them, foreign_*.txt.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { indexed, streamed } from "./values.mjs";

const [packages, folder] = process.argv.slice(2);
const { McapWriter } = createRequire(join(resolve(packages), "/"))("@mcap/core");

const inTime = (messages) => [...messages].sort((a, b) => (BigInt(a.log) < BigInt(b.log) ? -1 : a.log === b.log ? 0 : 1));
const expected = readFileSync(join(folder, "expected.jsonl"), "utf8").trim().split("\n").map((line) => JSON.parse(line));

for (const name of ["zstd", "plain"]) {
  const bytes = readFileSync(join(folder, `${name}.mcap`));
  const found = await indexed(bytes);
  assert.deepEqual(found.messages, inTime(expected), `${folder} ${name}`);
  assert.deepEqual(found.attachments, [["module.xml", "application/xml", "<module/>"]]);
  assert.deepEqual(found.metadata, [["board", { name: "left", release: "1.0" }]]);
  assert.deepEqual(streamed(bytes, false), expected);
}
assert.deepEqual(streamed(readFileSync(join(folder, "killed.mcap")), true), expected.slice(0, -1));
console.log(`${folder}: ${expected.length} values of others' readers are ours`);

for (const [name, settings] of Object.entries({ chunks: { chunkSize: 200 }, loose: { useChunks: false }, bare: {
  useStatistics: false, useSummaryOffsets: false, useChunkIndex: false, useMessageIndex: false,
  repeatSchemas: false, repeatChannels: false, chunkSize: 200 } })) {
  const parts = [];
  let position = 0n;
  const writable = {
    position: () => position,
    write: async (bytes) => {
      parts.push(Buffer.from(bytes));
      position += BigInt(bytes.length);
    },
  };
  const writer = new McapWriter({ writable, ...settings });
  await writer.start({ profile: "", library: "judge" });
  const schemaId = await writer.registerSchema({ name: "s", encoding: "jsonschema", data: Buffer.from("{}") });
  const lines = [];
  for (let n = 0; n < 40; ++n) {
    const channelId = await writer.registerChannel({ schemaId, topic: `t${n % 20}`, messageEncoding: "json", metadata: new Map() });
    const time = BigInt(1000 + ((n * 7) % 40));
    const data = Buffer.from(JSON.stringify({ n }));
    await writer.addMessage({ channelId, sequence: n, logTime: time, publishTime: time - 1n, data });
    lines.push([time, `t${n % 20} ${n} ${time} ${time - 1n} ${data.toString("hex")}\n`]);
  }
  await writer.addAttachment({ name: "a", logTime: 1n, createTime: 2n, mediaType: "text/plain", data: Buffer.from("abc") });
  await writer.end();
  writeFileSync(join(folder, `foreign_${name}.mcap`), Buffer.concat(parts));
  writeFileSync(join(folder, `foreign_${name}.txt`), lines.sort((a, b) => Number(a[0] - b[0])).map(([, line]) => line).join("") + "a 616263\n");
}
