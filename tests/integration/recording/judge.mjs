// SPDX-License-Identifier: Apache-2.0
// judge.mjs PACKAGES FOLDER: reads the recordings in FOLDER with the packages of others and compares each value with
// expected.jsonl; then writes recordings of its own there, foreign_*.mcap, and what is in them, foreign_*.txt.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [packages, folder] = process.argv.slice(2);
const require = createRequire(join(resolve(packages), "/"));
const { McapIndexedReader, McapStreamReader, McapWriter } = require("@mcap/core");
const { parseIDL } = require("@foxglove/omgidl-parser");
const { MessageReader } = require("@foxglove/omgidl-serialization");
const fzstd = require("fzstd");

const decompressHandlers = { zstd: (bytes, size) => fzstd.decompress(bytes, new Uint8Array(Number(size))) };

// As in expected.jsonl: 64-bit integers are texts there.
function plain(value) {
  if (typeof value === "bigint") {
    return value.toString();
  }
  if (Array.isArray(value) || ArrayBuffer.isView(value)) {
    return Array.from(value, plain);
  }
  if (value !== null && typeof value === "object") {
    return Object.fromEntries(Object.entries(value).map(([key, part]) => [key, plain(part)]));
  }
  return value;
}

class Decoder {
  schemas = new Map();
  channels = new Map();
  readers = new Map();

  values(message) {
    if (!this.readers.has(message.channelId)) {
      const channel = this.channels.get(message.channelId);
      const schema = this.schemas.get(channel.schemaId);
      assert.equal(schema.encoding, "omgidl");
      assert.equal(channel.messageEncoding, "cdr");
      const text = new TextDecoder().decode(schema.data);
      try {
        this.readers.set(message.channelId, new MessageReader(schema.name, parseIDL(text)));
      } catch (error) {
        throw new Error(`${error.message}\n${text}`);
      }
    }
    const value = this.readers.get(message.channelId).readMessage(message.data);
    return {
      topic: this.channels.get(message.channelId).topic,
      sequence: message.sequence,
      log: message.logTime.toString(),
      publish: message.publishTime.toString(),
      value: plain(value),
    };
  }
}

async function indexed(bytes) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const decoder = new Decoder();
  decoder.schemas = reader.schemasById;
  decoder.channels = reader.channelsById;
  const messages = [];
  for await (const message of reader.readMessages()) {
    messages.push(decoder.values(message));
  }
  const attachments = [];
  for await (const each of reader.readAttachments()) {
    attachments.push([each.name, each.mediaType, new TextDecoder().decode(each.data)]);
  }
  const metadata = [];
  for await (const each of reader.readMetadata()) {
    metadata.push([each.name, Object.fromEntries(each.metadata)]);
  }
  assert.equal(reader.header.profile, "indurop");
  assert.equal(Number(reader.statistics.messageCount), messages.length);
  assert.equal(reader.statistics.chunkCount, reader.chunkIndexes.length);
  assert.equal(reader.statistics.channelCount, reader.channelsById.size);
  for (const [id, count] of reader.statistics.channelMessageCounts) {
    const topic = reader.channelsById.get(id).topic;
    assert.equal(Number(count), messages.filter((each) => each.topic === topic).length);
  }
  return { messages, attachments, metadata };
}

// In the order of the file; all CRCs are checked. `cut`: the end of the file is missing.
function streamed(bytes, cut) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(bytes);
  const decoder = new Decoder();
  const messages = [];
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") {
      decoder.schemas.set(record.id, record);
    } else if (record.type === "Channel") {
      decoder.channels.set(record.id, record);
    } else if (record.type === "Message") {
      messages.push(decoder.values(record));
    }
  }
  assert.equal(reader.done(), !cut);
  return messages;
}

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
