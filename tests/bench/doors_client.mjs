// SPDX-License-Identifier: Apache-2.0
// A client of OPC UA for doors.py: node doors_client.mjs PACKAGES FOLDER URL ITEMS INTERVAL_MS. It browses all variables,
// monitors ITEMS of them, and prints a line of JSON for that; then, for each line of its input, how many values have come.
import { createRequire } from "node:module";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

const [packages, folder, url, items, interval] = process.argv.slice(2);
const say = console.log;
console.log = console.warn = console.error;
const ua = await import(pathToFileURL(createRequire(`${packages}/package.json`).resolve("node-opcua")));

const manager = new ua.OPCUACertificateManager({ rootFolder: folder, automaticallyAcceptUnknownCertificate: true });
await manager.initialize();
const client = ua.OPCUAClient.create({ endpointMustExist: false, connectionStrategy: { maxRetry: 0 }, clientCertificateManager: manager, defaultTransactionTimeout: 60_000 });
await client.connect(url);
const session = await client.createSession();

// Level by level, with hundreds of nodes in a request, as SCADA systems browse.
async function browseAll() {
  const variables = [];
  const seen = new Set();
  for (let level = ["i=85"]; level.length > 0; ) {
    const next = [];
    for (let begin = 0; begin < level.length; begin += 500) {
      const wanted = level.slice(begin, begin + 500).map((nodeId) => ({ nodeId, referenceTypeId: "HierarchicalReferences", includeSubtypes: true, resultMask: 63 }));
      for (let found of await session.browse(wanted)) {
        for (;;) {
          for (const one of found.references ?? []) {
            const id = one.nodeId.toString();
            if (seen.has(id) || !id.startsWith("ns=2")) continue;
            seen.add(id);
            next.push(id);
            if (one.nodeClass === ua.NodeClass.Variable) variables.push(id);
          }
          if (!found.continuationPoint?.length) break;
          found = await session.browseNext(found.continuationPoint, false);
        }
      }
    }
    level = next;
  }
  return { variables, nodes: seen.size };
}

const begin = performance.now();
const { variables, nodes } = await browseAll();
const browsed = performance.now() - begin;
const subscription = await session.createSubscription2({
  requestedPublishingInterval: Number(interval), requestedLifetimeCount: 6000, requestedMaxKeepAliveCount: 100, maxNotificationsPerPublish: 100_000, publishingEnabled: true, priority: 1,
});
let values = 0;
const chosen = variables.filter((id) => !id.includes(".")).slice(0, Number(items));
for (let at = 0; at < chosen.length; at += 1000) {
  const group = await subscription.monitorItems(
    chosen.slice(at, at + 1000).map((nodeId) => ({ nodeId, attributeId: ua.AttributeIds.Value })),
    { samplingInterval: Number(interval), queueSize: 1, discardOldest: true }, ua.TimestampsToReturn.Both,
  );
  group.on("changed", () => { values += 1; });
}
say(JSON.stringify({ nodes, browse_s: browsed / 1000, items: chosen.length }));
for await (const line of createInterface({ input: process.stdin })) {
  if (line === "end") break;
  say(JSON.stringify({ values }));
}
await client.disconnect();
