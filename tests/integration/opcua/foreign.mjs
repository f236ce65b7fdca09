// SPDX-License-Identifier: Apache-2.0
// A server of OPC UA that is not ours, for indurop-opcua --client: node foreign.mjs PACKAGES FOLDER PORT. It has a variable
// of each type of number in the namespace urn:maker:press. Each line of standard input is a request, each line of standard
// output its answer; the first line is its port.
import { createRequire } from "node:module";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

const [packages, folder, port] = process.argv.slice(2);
const say = console.log;
console.log = console.warn = console.error;
const require = createRequire(`${packages}/package.json`);
const ua = await import(pathToFileURL(require.resolve("node-opcua")));
const { DataType, MessageSecurityMode, OPCUACertificateManager, OPCUAServer, SecurityPolicy, StatusCodes, Variant } = ua;

const manager = new OPCUACertificateManager({ rootFolder: `${folder}/foreign`, automaticallyAcceptUnknownCertificate: true });
await manager.initialize();
const server = new OPCUAServer({
  port: Number(port), host: "127.0.0.1", hostname: "127.0.0.1", serverCertificateManager: manager,
  securityModes: [MessageSecurityMode.None, MessageSecurityMode.Sign, MessageSecurityMode.SignAndEncrypt],
  securityPolicies: [SecurityPolicy.None, SecurityPolicy.Basic256Sha256], allowAnonymous: true,
  userManager: { isValidUser: (user, password) => user === "anna" && password === "of the press" },
});
await server.initialize();
const space = server.engine.addressSpace;
const own = space.registerNamespace("urn:maker:press");
const variables = new Map();
const long = (text) => { const bits = BigInt.asUintN(64, BigInt(text)); return [Number(bits >> 32n), Number(bits & 0xFFFF_FFFFn)]; };
const is_long = (type) => type === DataType.Int64 || type === DataType.UInt64;
const value_of = (type, value) => new Variant({ dataType: type, arrayType: ua.VariantArrayType.Scalar, value: is_long(type) ? long(value) : value });
const shown = (variant, type) => {
  if (!is_long(type)) return variant.value;
  const bits = (BigInt(variant.value[0]) << 32n) | BigInt(variant.value[1] >>> 0);
  return `${type === DataType.Int64 ? BigInt.asIntN(64, bits) : BigInt.asUintN(64, bits)}`;
};
for (const name of ["Boolean", "SByte", "Byte", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64", "Float", "Double", "String"]) {
  const type = DataType[name];
  const one = own.addVariable({ organizedBy: space.rootFolder.objects, browseName: name, nodeId: `s=${name}`, dataType: name, value: value_of(type, name === "Boolean" ? false : name === "String" ? "x" : 0) });
  variables.set(name, { one, type });
}
const fixed = own.addVariable({ organizedBy: space.rootFolder.objects, browseName: "Fixed", nodeId: "s=Fixed", dataType: "Double", accessLevel: "CurrentRead", userAccessLevel: "CurrentRead", value: value_of(DataType.Double, 1) });
variables.set("Fixed", { one: fixed, type: DataType.Double });
own.addVariable({ organizedBy: space.rootFolder.objects, browseName: "List", nodeId: "s=List", dataType: "Double", valueRank: 1, value: new Variant({ dataType: DataType.Double, arrayType: 1, value: [1, 2] }) });
await server.start();
say(server.endpoints[0].port);

const actions = {
  set: ({ name, value, status }) => {
    const { one, type } = variables.get(name);
    one.setValueFromSource(value_of(type, value === "NaN" ? NaN : value), StatusCodes[status ?? "Good"]);
  },
  get: ({ name }) => shown(variables.get(name).one.readValue().value, variables.get(name).type),
  sessions: () => server.engine.currentSessionCount,
};
for await (const line of createInterface({ input: process.stdin })) {
  const request = JSON.parse(line);
  say(JSON.stringify({ done: actions[request.do](request) ?? null }));
}
await server.shutdown(0);
