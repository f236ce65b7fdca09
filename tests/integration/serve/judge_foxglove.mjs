// SPDX-License-Identifier: Apache-2.0
// Foxglove's own client and decoders against a server: judge_foxglove.mjs PACKAGES ADDRESS BOARD TOKEN
import assert from "node:assert/strict";
import {createRequire} from "node:module";
import path from "node:path";

const [packages, address, board, token] = process.argv.slice(2);
const require = createRequire(path.resolve(packages, "x.js"));
const {FoxgloveClient} = require("@foxglove/ws-protocol");
const {parseIDL} = require("@foxglove/omgidl-parser");
const {MessageReader} = require("@foxglove/omgidl-serialization");
const WebSocket = require("ws");

const values = {gain: 3.5, mode: "AUTO", "station::name": "drill", "joints[1].y": -12.5, "press::door_open": true, starts: -7};
const answer = await fetch(`${address}/api/v1/boards/${board}/set`, {
  method: "POST",
  headers: {Authorization: `Bearer ${token}`, "Content-Type": "application/json"},
  body: JSON.stringify({values}),
});
assert.equal(answer.status, 200, await answer.text());

const plain = (value) => typeof value === "bigint" ? Number(value)
  : ArrayBuffer.isView(value) || Array.isArray(value) ? Array.from(value, plain)
  : value !== null && typeof value === "object" ? Object.fromEntries(Object.entries(value).map(([key, part]) => [key, plain(part)]))
  : value;

// All that a client of this subprotocol sees until `enough` says so.
async function look(protocol, enough, act = () => {}) {
  const ws = new WebSocket(`${address.replace("http", "ws")}/`, [protocol]);
  const client = new FoxgloveClient({ws});
  const seen = {channels: new Map(), latest: {}, messages: [], statuses: [], info: null};
  const topics = new Map();
  await new Promise((resolve, reject) => {
    const late = setTimeout(() => reject(new Error(`waited in vain: ${JSON.stringify(seen.latest)}`)), 30_000);
    client.on("error", reject);
    client.on("serverInfo", (info) => { seen.info = info; });
    client.on("status", (status) => { seen.statuses.push(status); });
    client.on("advertise", (channels) => {
      for (const channel of channels) {
        assert.equal(channel.encoding, "cdr");
        assert.equal(channel.schemaEncoding, "omgidl");
        seen.channels.set(channel.topic, channel);
        topics.set(client.subscribe(channel.id), [channel.topic, new MessageReader(channel.schemaName, parseIDL(channel.schema))]);
      }
      act(client, topics);
    });
    client.on("message", ({subscriptionId, timestamp, data}) => {
      const [topic, reader] = topics.get(subscriptionId);
      const message = plain(reader.readMessage(data));
      seen.latest[topic] = message;
      seen.messages.push([topic, timestamp, message]);
      if (enough(seen)) {
        clearTimeout(late);
        resolve();
      }
    });
  });
  client.close();
  return seen;
}

for (const protocol of [FoxgloveClient.SUPPORTED_SUBPROTOCOL, "foxglove.sdk.v1"]) {
  const seen = await look(protocol, ({messages}) => messages.filter(([topic]) => topic === "knu::Robot::tick").length > 20);
  assert.match(seen.info.name, /^InduRoP /);
  assert.deepEqual(seen.info.capabilities, []);
  const {latest} = seen;
  assert.deepEqual([...seen.channels.keys()].sort(), Object.keys(latest).sort(), "each variable is sent");
  assert.deepEqual(latest["knu::Robot::gain"], {value: 3.5});
  assert.deepEqual(latest["knu::Robot::mode"], {value: 1});
  assert.deepEqual(latest["station::name"], {value: "drill"});
  assert.deepEqual(latest["station::starts"], {value: -7});
  assert.deepEqual(latest["press::door_open"], {value: true});
  const joints = latest["knu::Robot::joints"].value;
  assert.equal(joints.length, 10);
  assert.deepEqual(joints[1], {x: 0, y: -12.5, z: 0});
  const ticks = seen.messages.filter(([topic]) => topic === "knu::Robot::tick");
  for (let i = 1; i < ticks.length; ++i) {
    // Not more: where the machine is busy the node may have had no turn between two samples.
    assert.ok(ticks[i][2].value >= ticks[i - 1][2].value, "the tick does not fall");
    assert.ok(ticks[i][1] > ticks[i - 1][1], "so does the time");
  }
  assert.ok(ticks.at(-1)[2].value > ticks[0][2].value, "the tick rises");
  assert.ok(Math.abs(Number(ticks[0][1] / 1_000_000n) - Date.now()) < 60_000);
}

// What it does not serve is said; what is unsubscribed comes no more; an id is given once.
const only_ticks = (messages) => messages.length > 60 && messages.slice(-40).every(([topic]) => topic === "knu::Robot::tick");
const seen = await look("foxglove.websocket.v1", ({messages, statuses}) => only_ticks(messages) && statuses.length > 0, (client, topics) => {
  client.getParameters(["x"]);
  for (const [id, [topic]] of topics) {
    if (topic !== "knu::Robot::tick") {
      client.unsubscribe(id);
    }
  }
});
assert.match(seen.statuses[0].message, /'getParameters' is not served/);
console.log(`foxglove: ${seen.channels.size} channels`);
