// SPDX-License-Identifier: Apache-2.0
// What packages of others read in a recording; all of it is checked, CRCs and statistics too.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [packages] = process.argv.slice(2);
const require = createRequire(join(resolve(packages), "/"));
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
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

export async function indexed(bytes) {
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
export function streamed(bytes, cut) {
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
