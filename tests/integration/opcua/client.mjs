// SPDX-License-Identifier: Apache-2.0
// A client of OPC UA that a test drives: node client.mjs PACKAGES FOLDER. Each line of standard input is a request
// {"do": NAME, ...}, each line of standard output its answer. Standard output has nothing else.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

const [packages, folder] = process.argv.slice(2);
console.log = console.warn = console.error;
const ua = await import(pathToFileURL(createRequire(`${packages}/package.json`).resolve("node-opcua")));
const { AttributeIds, ClientSubscription, DataType, MessageSecurityMode, OPCUAClient, SecurityPolicy, TimestampsToReturn, UserTokenType, Variant, VariantArrayType } = ua;

let client, session, subscription;
const items = new Map();
const changes = {};  // newest values by node id
const events = [];
const taken = new Map();  // everything that items with a queue have reported, by node id

const plain = (value) => {
  if (value === null || value === undefined) return null;
  if (typeof value === "number") return Number.isFinite(value) ? value : `${value}`;
  if (typeof value === "bigint") return `${value}`;
  if (Buffer.isBuffer(value)) return value.toString("hex");
  if (ArrayBuffer.isView(value)) return Array.from(value, plain);
  if (Array.isArray(value)) return value.map(plain);
  if (value instanceof Date) return value.toISOString();
  if (value instanceof ua.NodeId) return value.toString();
  if (value instanceof ua.LocalizedText) return value.text;
  if (typeof value !== "object") return value;
  const names = value.schema ? allFields(value.schema) : Object.keys(value);
  return Object.fromEntries(names.filter((name) => typeof value[name] !== "function").map((name) => [name, plain(value[name])]));
};
const allFields = (schema) => [...(schema._baseSchema && schema._baseSchema !== schema ? allFields(schema._baseSchema) : []), ...schema.fields.map((field) => field.name)];
const shown = (value) => ({
  code: value.statusCode.name, value: plain(value.value?.value), type: DataType[value.value?.dataType], dims: plain(value.value?.dimensions),
  source: value.sourceTimestamp?.getTime() ?? null, server: value.serverTimestamp?.getTime() ?? null,
});

const ns_of = (value) => `${BigInt(value.sourceTimestamp?.getTime() ?? 0) * 1_000_000n + BigInt(Math.floor((value.sourcePicoseconds ?? 0) / 1000))}`;
const parameters_of = ({ interval, queue, oldest }) => ({ samplingInterval: interval ?? 0, queueSize: queue, discardOldest: oldest ?? true });
const revised = (item) => ({ code: item.statusCode?.name ?? "Good", interval: item.monitoringParameters.samplingInterval, queue: item.monitoringParameters.queueSize });

const actions = {
  async endpoints({ url }) {
    const one = OPCUAClient.create({ endpointMustExist: false, connectionStrategy: { maxRetry: 0 } });
    await one.connect(url);
    const found = await one.getEndpoints();
    await one.disconnect();
    return found.map((end) => ({
      mode: MessageSecurityMode[end.securityMode], policy: end.securityPolicyUri.split("#")[1],
      users: end.userIdentityTokens.map(({ tokenType }) => UserTokenType[tokenType]),
    }));
  },
  // ca: accepts servers with a certificate of this authority only; else any.
  async connect({ url, mode, policy, user, password, ca, revoked }) {
    client = OPCUAClient.create({
      endpointMustExist: false, securityMode: MessageSecurityMode[mode ?? "None"], securityPolicy: SecurityPolicy[policy ?? "None"],
      connectionStrategy: { maxRetry: 0 }, requestedSessionTimeout: 60_000, defaultTransactionTimeout: 60_000, clientCertificateManager: ca ? await strict(ca, revoked) : manager,
    });
    try {
      await client.connect(url);
      session = await client.createSession(user ? { type: UserTokenType.UserName, userName: user, password } : undefined);
    } catch (error) {
      await client.disconnect();
      throw error;
    }
    return session.sessionId.toString();
  },
  async close() {
    await session?.close();
    await client?.disconnect();
    session = subscription = undefined;
    items.clear();
  },
  // all: references of any type in both directions, not only those down the hierarchy.
  async browse({ node, all }) {
    const answer = await session.browse({
      nodeId: node, referenceTypeId: all ? "References" : "HierarchicalReferences", includeSubtypes: true, resultMask: 63, browseDirection: all ? 2 : 0,
    });
    return (answer.references ?? []).map((one) => ({
      node: one.nodeId.toString(), name: one.browseName.name, type: one.typeDefinition.toString(), forward: one.isForward,
      namespace: one.browseName.namespaceIndex, reference: one.referenceTypeId.toString(), kind: ua.NodeClass[one.nodeClass],
    }));
  },
  async read({ nodes, attribute, range }) {
    const wanted = nodes.map((nodeId) => ({ nodeId, attributeId: AttributeIds[attribute ?? "Value"], indexRange: range ? new ua.NumericRange(range) : undefined }));
    return (await session.read(wanted)).map(shown);
  },
  async write({ node, type, value, dims, range, array }) {
    const dataType = DataType[type];
    const arrayType = dims ? VariantArrayType.Matrix : array ? VariantArrayType.Array : VariantArrayType.Scalar;
    const variant = new Variant({ dataType, arrayType, dimensions: dims ?? null, value });
    const code = await session.write({ nodeId: node, attributeId: AttributeIds.Value, indexRange: range ? new ua.NumericRange(range) : undefined, value: { value: variant } });
    return code.name;
  },
  // Reads a structure, changes fields and writes it as a whole.
  async change({ node, fields }) {
    const { value } = await session.read({ nodeId: node, attributeId: AttributeIds.Value });
    for (const [name, one] of Object.entries(fields)) value.value[name] = one;
    return (await session.write({ nodeId: node, attributeId: AttributeIds.Value, value: { value } })).name;
  },
  async monitor({ nodes, interval }) {
    subscription ??= await session.createSubscription2({
      requestedPublishingInterval: 50, requestedLifetimeCount: 6000, requestedMaxKeepAliveCount: 100, maxNotificationsPerPublish: 10_000, publishingEnabled: true, priority: 1,
    });
    const answers = [];
    for (const nodeId of nodes) {
      const item = await subscription.monitor({ nodeId, attributeId: AttributeIds.Value }, { samplingInterval: interval ?? 100, queueSize: 1, discardOldest: true }, TimestampsToReturn.Both);
      // A value that is not known in time is reported as such first.
      item.on("changed", (value) => { changes[nodeId] = { ...shown(value), count: (changes[nodeId]?.count ?? 0) + (value.statusCode.isGood() ? 1 : 0) }; });
      items.set(nodeId, item);
      answers.push(item.statusCode?.name ?? "Good");
    }
    return answers;
  },
  // Items with a queue, in a subscription of their own; what they report can be taken.
  async every({ nodes, publishing, ...words }) {
    const own = await session.createSubscription2({
      requestedPublishingInterval: publishing ?? 100, requestedLifetimeCount: 6000, requestedMaxKeepAliveCount: 100, maxNotificationsPerPublish: 10_000, publishingEnabled: true, priority: 1,
    });
    const answers = [];
    for (const nodeId of nodes) {
      const item = await own.monitor({ nodeId, attributeId: AttributeIds.Value }, parameters_of(words), TimestampsToReturn.Both);
      taken.set(nodeId, taken.get(nodeId) ?? []);
      item.on("changed", (value) => {
        const { statusCode: code } = value;
        taken.get(nodeId).push([code.name.replace(/WithOverflowBit|#.*/, ""), plain(value.value?.value), ns_of(value), code.hasOverflowBit]);
      });
      items.set(nodeId, item);
      answers.push(revised(item));
    }
    return answers;
  },
  async modify({ node, ...words }) {
    const answer = await items.get(node).modify(parameters_of(words), TimestampsToReturn.Both);
    return { code: answer.statusCode.name, interval: answer.revisedSamplingInterval, queue: answer.revisedQueueSize };
  },
  async mode({ node, mode }) {
    await items.get(node).setMonitoringMode(ua.MonitoringMode[mode]);
  },
  async take({ node }) {
    return taken.get(node).splice(0);
  },
  async unmonitor({ nodes }) {
    for (const node of nodes) {
      await items.get(node).terminate();
      items.delete(node);
      delete changes[node];
    }
  },
  async changes() { return changes; },
  async listen({ node }) {
    subscription ??= await session.createSubscription2({ requestedPublishingInterval: 50, requestedLifetimeCount: 6000, requestedMaxKeepAliveCount: 100, publishingEnabled: true, priority: 1 });
    const fields = ["EventId", "SourceName", "Message", "Severity", "ConditionName", "Retain", "ActiveState.Id", "AckedState.Id", "ClientUserId", "Comment"];
    const filter = ua.constructEventFilter([...fields, "ConditionId"]);
    filter.selectClauses.at(-1).typeDefinitionId = ua.resolveNodeId("ConditionType");
    filter.selectClauses.at(-1).browsePath = [];
    filter.selectClauses.at(-1).attributeId = AttributeIds.NodeId;
    const item = await subscription.monitor({ nodeId: node, attributeId: AttributeIds.EventNotifier }, { samplingInterval: 0, queueSize: 100, discardOldest: true, filter }, TimestampsToReturn.Both);
    item.on("changed", (values) => events.push(Object.fromEntries([...fields, "ConditionId"].map((name, i) => [name, plain(values[i].value)]))));
  },
  async events() { return events; },
  // One answer of HistoryRead; times are texts of ns since 1970, null: not said.
  async history({ node, start, end, most, bounds, modified, point, release, range, details }) {
    const date = (ns) => {
      if (ns === null || ns === undefined) return null;
      const at = new Date(Number(BigInt(ns) / 1_000_000n));
      at.picoseconds = Number(BigInt(ns) % 1_000_000n) * 1000;
      return at;
    };
    const request = new ua.HistoryReadRequest({
      historyReadDetails: details === "atTime" ? new ua.ReadAtTimeDetails({ reqTimes: [date(start)] }) : new ua.ReadRawModifiedDetails({
        isReadModified: modified ?? false, startTime: date(start), endTime: date(end), numValuesPerNode: most ?? 0, returnBounds: bounds ?? false,
      }),
      timestampsToReturn: TimestampsToReturn.Both,
      releaseContinuationPoints: release ?? false,
      nodesToRead: [{ nodeId: node, continuationPoint: point ? Buffer.from(point, "hex") : undefined, indexRange: range ? new ua.NumericRange(range) : undefined }],
    });
    const [result] = (await session.historyRead(request)).results;
    return {
      code: result.statusCode.name, point: result.continuationPoint?.length ? result.continuationPoint.toString("hex") : null,
      values: (result.historyData?.dataValues ?? []).map((one) => ({
        code: one.statusCode.name, value: plain(one.value?.value), dims: plain(one.value?.dimensions),
        ns: `${BigInt(one.sourceTimestamp.getTime()) * 1_000_000n + BigInt(Math.floor((one.sourcePicoseconds ?? 0) / 1000))}`,
      })),
    };
  },
  // Calls a method; words of structures are objects, `types` says others than those of the method.
  async invoke({ object, method, words, types }) {
    const { inputArguments, outputArguments } = await session.getArgumentDefinition(method);
    const inputs = [];
    for (const [i, word] of words.entries()) {
      const dataType = inputArguments[i]?.dataType ?? ua.resolveNodeId("Int32");
      const structure = word !== null && typeof word === "object" && !Array.isArray(word);
      if (structure) inputs.push({ dataType: DataType.ExtensionObject, value: await session.constructExtensionObject(dataType, word) });
      else inputs.push({ dataType: DataType[types?.[i]] ?? (dataType.namespace === 0 ? dataType.value : DataType.Int32), value: word });
    }
    const answer = await session.call({ objectId: object, methodId: method, inputArguments: inputs });
    return {
      code: answer.statusCode.name, outputs: (answer.outputArguments ?? []).map((one) => plain(one.value)),
      inputs: inputArguments.map(({ name }) => name), results: outputArguments.map(({ name }) => name),
    };
  },
  async refresh() {
    return (await session.call({ objectId: "i=2782", methodId: "i=3875", inputArguments: [{ dataType: "UInt32", value: subscription.subscriptionId }] })).statusCode.name;
  },
  async call({ object, method, event, text }) {
    const answer = await session.call({
      objectId: object, methodId: method,
      inputArguments: event === undefined ? [] : [{ dataType: "ByteString", value: Buffer.from(event, "hex") }, { dataType: "LocalizedText", value: { text } }],
    });
    return answer.statusCode.name;
  },
};

const der = (file, what) => Buffer.from(new RegExp(`-----BEGIN ${what}-----([^-]+)-----END`).exec(readFileSync(file, "utf8"))[1], "base64");
async function strict(ca, revoked) {
  const made = new ua.OPCUACertificateManager({ rootFolder: `${folder}/strict`, automaticallyAcceptUnknownCertificate: false });
  await made.initialize();
  await made.addIssuer(der(ca, "CERTIFICATE"), false, true);
  await made.addRevocationList(der(revoked, "X509 CRL"), "issuers");
  return made;
}

const manager = new ua.OPCUACertificateManager({ rootFolder: `${folder}/client`, automaticallyAcceptUnknownCertificate: true });
await manager.initialize();
for await (const line of createInterface({ input: process.stdin })) {
  const request = JSON.parse(line);
  let answer;
  try {
    answer = { done: (await actions[request.do](request)) ?? null };
  } catch (error) {
    answer = { error: error.message };
  }
  process.stdout.write(`${JSON.stringify(answer)}\n`);
}
process.exit(0);
