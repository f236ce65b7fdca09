// SPDX-License-Identifier: Apache-2.0
// Payloads of Sparkplug B as npm's sparkplug-payload reads and writes them, one line of JSON for each line of JSON. The
// types of data come from the births before, as in a host. decode.mjs PACKAGES
import {createRequire} from "node:module";
import path from "node:path";
import readline from "node:readline";

const require = createRequire(path.resolve(process.argv[2], "x.js"));
const sparkplug = require("sparkplug-payload").get("spBv1.0");
const Payload = require("sparkplug-payload/lib/sparkplugPayloadProto").org.eclipse.tahu.protobuf.Payload;

const types = new Map();  // by alias and by name
const plain = (value) => JSON.parse(JSON.stringify(value, (_, one) =>
  one && typeof one === "object" && "low" in one && "high" in one ? Number(BigInt.asIntN(64, (BigInt(one.high) << 32n) | BigInt(one.low >>> 0))) : one));

function decode(bytes) {
  const raw = Payload.decode(bytes);
  for (const metric of raw.metrics) {
    const keys = [metric.name, metric.alias && `alias ${metric.alias}`].filter(Boolean);
    if (metric.datatype) keys.forEach((key) => types.set(key, metric.datatype));
    else metric.datatype = types.get(keys[0]) ?? 0;
  }
  const payload = sparkplug.decodePayload(Payload.encode(raw).finish());
  return plain(payload);
}

for await (const line of readline.createInterface({input: process.stdin})) {
  const {hex, payload} = JSON.parse(line);
  const done = hex !== undefined ? decode(Buffer.from(hex, "hex")) : {hex: Buffer.from(sparkplug.encodePayload(payload)).toString("hex")};
  console.log(JSON.stringify(done));
}
