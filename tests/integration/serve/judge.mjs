// SPDX-License-Identifier: Apache-2.0
// Is the description valid OpenAPI, does every path of it answer, and does each answer fit its schema? Are the frames of the
// stream what docs/serve.md says, for a WebSocket client that is not ours? judge.mjs PACKAGES ADDRESS BOARD TOKEN
import {createRequire} from "node:module";
import path from "node:path";

const [packages, address, board, token] = process.argv.slice(2);
const require = createRequire(path.resolve(packages, "x.js"));
const SwaggerParser = require("@apidevtools/swagger-parser");
const Ajv = require("ajv").default;
const WebSocket = require("ws");

function fail(text) {
  console.error(text);
  process.exit(1);
}

const described = await (await fetch(`${address}/api/v1/openapi.json`)).json();
const api = await SwaggerParser.validate(structuredClone(described), {dereference: {circular: true}});
// OpenAPI's "nullable" is ajv's own; formats and examples are not used.
const ajv = new Ajv({strict: false, allErrors: true});
ajv.addSchema({$id: "api", ...described});
const refer = (schema) => JSON.parse(JSON.stringify(schema).replaceAll('"#/', '"api#/'));

const bodies = {
  signIn: {user: "ana", password: "correct horse"},
  set: {values: {gain: 2}},
  force: {values: {gain: 3}, for_ns: 60_000_000_000},
  release: {all: true},
  setLock: {lock: "none", reason: "a trial"},
  acknowledgeAlarms: {all: true},
  shelveAlarms: {all: true, for_ns: 1_000_000_000},
  unshelveAlarms: {all: true},
  takeCalibrationPoint: {},
  dropCalibrationPoint: {all: true},
  acceptCalibration: {},
  writeGuidedPath: {job: "seam"},
};
const queries = {valueHistory: "?name=gain&from_ns=1&to_ns=1800000000000000000"};
const parts = {user: "ana", board, module: "modify", name: "knu::Robot::joints[1]"};
// Orders to modules: the node of this test answers none, it has no tape and no functions, and
// the server shows no plant, no PLC program and no robot with files. Names of recipes are no names of variables.
const unanswered = new Set(["startModule", "stopModule", "restartModule", "schedule", "scope", "plant", "plantHistory", "plantDifference", "plantRollback", "beginJog", "keepJog", "endJog", "plc", "plcLive", "plcModel", "recording", "recordedValues", "recordedTick", "replayRecording", "recipe", "saveRecipe", "loadRecipe", "removeRecipe", "callFunction", "calibration", "takeCalibrationPoint", "dropCalibrationPoint", "acceptCalibration", "writeGuidedPath"]);
const take_lease = async () => (await (await fetch(`${address}/api/v1/boards/${board}/force`, {
  method: "POST",
  headers: {Authorization: `Bearer ${token}`, "Content-Type": "application/json"},
  body: JSON.stringify({values: {mode: "AUTO"}, lease: true}),
})).json()).lease;
let answered = 0;
for (const [pattern, methods] of Object.entries(described.paths)) {
  for (const [method, operation] of Object.entries(methods)) {
    if (method === "parameters") continue;
    if (operation.operationId === "renewLease") parts.lease = await take_lease();
    for (const wrong of [false, true]) {
      const where = pattern.replace(/\{(\w+)\}/g, (_, name) => encodeURIComponent(wrong ? "no such thing" : parts[name]))
        + (queries[operation.operationId] ?? "");
      if (unanswered.has(operation.operationId) && (!wrong || !pattern.includes("{")) && operation.operationId !== "schedule") continue;
      const answer = await fetch(address + where, {
        method: method.toUpperCase(),
        headers: {Authorization: `Bearer ${token}`, "Content-Type": "application/json"},
        body: method === "post" && operation.requestBody ? JSON.stringify(bodies[operation.operationId]) : undefined,
      });
      const text = await answer.text();
      const expected = wrong && pattern.includes("{") ? 404 : 200;
      if (answer.status !== expected) fail(`${method} ${where}: ${answer.status} instead of ${expected}: ${text}`);
      let response = operation.responses[answer.status] ?? operation.responses.default;
      if (response.$ref) response = described.components.responses[response.$ref.split("/").pop()];
      const [type] = Object.keys(response.content);
      if (!answer.headers.get("content-type").startsWith(type)) fail(`${method} ${where}: ${answer.headers.get("content-type")}`);
      const check = ajv.compile(refer(response.content[type].schema));
      if (!check(type === "application/json" ? JSON.parse(text) : text)) fail(`${method} ${where}: ${ajv.errorsText(check.errors)}\n${text.slice(0, 2000)}`);
      ++answered;
    }
  }
}

const socket = new WebSocket(address.replace("http", "ws") + "/api/v1/stream", ["indurop.v1", `indurop.token.${token}`]);
socket.binaryType = "arraybuffer";
const frames = [];
let subscribed;
await new Promise((done, failed) => {
  socket.on("error", failed);
  socket.on("open", () => socket.send(JSON.stringify(
    {type: "subscribe", id: 1, board, names: ["tick", "joints", "mode", "name"], rate_hz: 50, binary: true})));
  socket.on("message", (data, binary) => {
    if (!binary) {
      const word = JSON.parse(data.toString());
      subscribed = word.type === "subscribed" ? word : subscribed;
      return;
    }
    frames.push(new DataView(data));
    if (frames.length === 10) done();
  });
});
socket.close();
const type = ajv.compile({$ref: "api#/components/schemas/Type"});
for (const variable of subscribed.variables) {
  if (!type(variable.form)) fail(`form of ${variable.name}: ${ajv.errorsText(type.errors)}`);
}
let last = 0n;
for (const view of frames) {
  const seq = view.getBigUint64(8, true);
  if (view.byteLength !== subscribed.record_size || view.getUint8(0) !== 1 || seq <= last) fail("a frame is not as described");
  last = seq;
  const tick = view.getUint32(subscribed.variables[0].offset, true);
  const x = view.getFloat64(subscribed.variables[1].offset, true);
  if (Math.abs(x - tick * 0.5) > 50) fail(`tick ${tick} and joints[0].x ${x} do not belong together`);
}
console.log(`${Object.keys(api.paths).length} paths, ${answered} answers and ${frames.length} frames are as described`);
