// SPDX-License-Identifier: Apache-2.0
// judge_parts.mjs PACKAGES FOLDER: the recording run.mcap of a node, the whole of it cut to cut.mcap, a part of it in
// part.mcap, and joined.mcap of it: packages of others read the same messages in all of them.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { indexed, streamed } from "./values.mjs";

const folder = process.argv[3];
const found = {};
for (const name of ["run", "cut", "part", "joined"]) {
  const bytes = readFileSync(join(folder, `${name}.mcap`));
  found[name] = (await indexed(bytes)).messages;
  assert.equal(streamed(bytes, false).length, found[name].length);
}
const key = (message) => JSON.stringify(message);
const sorted = (messages) => messages.map(key).sort();
assert.ok(found.run.length > 1000);
assert.deepEqual(sorted(found.cut), sorted(found.run));
const bare = found.joined.map((message) => ({ ...message, topic: message.topic.slice(message.topic.indexOf("/") + 1) }));
assert.deepEqual(sorted(bare), sorted(found.run));
const all = new Set(found.run.map(key));
const runs = found.part.filter((message) => message.topic === "indurop/runs");
assert.equal(runs.length, 300);
assert.ok(runs.every((message) => all.has(key(message))));
const old = found.part.filter((message) => !all.has(key(message)));
assert.ok(old.every((message) => BigInt(message.log) <= BigInt(runs[0].log)), "only what was known before is new");
console.log(`${found.run.length} messages of a node, cut and joined, are the same to others' readers`);
