// SPDX-License-Identifier: Apache-2.0
// The OPC UA server: where it listens, what it demands of clients, what it limits.

import { readFile } from "node:fs/promises";
import { hostname } from "node:os";
import { join } from "node:path";

import {
  allPermissions, MessageSecurityMode, OPCUACertificateManager, OPCUAServer, PermissionType, SecurityPolicy, UserTokenType, WellKnownRoles,
  type ServerSession,
} from "node-opcua";

import { make_certificate_manager } from "../certificates";
import { log } from "../log";
import { VERSION, type Options } from "../options";
import { nodeset_file } from "../space/nodesets";
import { MOST_QUEUED } from "./every";
import { MOST_VALUES } from "./history";
import type { Users } from "./users";

export const NAMESPACE = "urn:indurop:boards";

const MESSAGE_BYTES = 8 * 1024 * 1024;
const CHUNK_BYTES = 64 * 1024;
const CHUNKS = 256;
const NODES_PER_REQUEST = 10_000;
const NODES_PER_HISTORY_READ = 100;
const READ_ONLY = PermissionType.Browse | PermissionType.Read | PermissionType.ReadHistory | PermissionType.ReceiveEvents | PermissionType.Call;

export function is_loopback(address: string): boolean {
  return address === "localhost" || address === "::1" || address.startsWith("127.");
}

// Clients' certificates: on loopback any, elsewhere those in trusted/certs, and those of --ca.
async function certificates(options: Options): Promise<OPCUACertificateManager> {
  const manager = await make_certificate_manager(join(options.state, "pki"), is_loopback(options.bind));
  if (options.ca) await trust_authority(manager, options);
  return manager;
}

function der_of(pem: string, what: string): Buffer {
  const found = new RegExp(`-----BEGIN ${what}-----([^-]+)-----END ${what}-----`).exec(pem);
  if (!found) throw new Error(`no ${what} in PEM form`);
  return Buffer.from(found[1], "base64");
}

async function trust_authority(manager: OPCUACertificateManager, options: Options): Promise<void> {
  const added = await manager.addIssuer(der_of(await readFile(options.ca, "utf8"), "CERTIFICATE"), false, true);
  if (`${added}` !== "Good") throw new Error(`${options.ca}: it is no authority: ${added}`);
  const listed = await manager.addRevocationList(der_of(await readFile(options.revoked, "utf8"), "X509 CRL"), "issuers");
  if (`${listed}` !== "Good") throw new Error(`${options.revoked}: it is no revocation list: ${listed}`);
}

function limits(options: Options): object {
  return {
    serverCapabilities: {
      maxSessions: options.sessions,
      maxSubscriptions: options.sessions * 10,
      maxSubscriptionsPerSession: 10,
      maxMonitoredItems: options.items,
      maxMonitoredItemsPerSubscription: options.items,
      maxMonitoredItemsQueueSize: MOST_QUEUED,
      maxBrowseContinuationPoints: 10,
      maxArrayLength: 1_000_000,
      maxStringLength: 1_000_000,
      maxByteStringLength: MESSAGE_BYTES,
      minSupportedSampleRate: 0,  // every run
      operationLimits: {
        maxNodesPerRead: NODES_PER_REQUEST, maxNodesPerBrowse: NODES_PER_REQUEST, maxNodesPerWrite: 1000,
        maxMonitoredItemsPerCall: NODES_PER_REQUEST, maxNodesPerMethodCall: 100, maxNodesPerRegisterNodes: NODES_PER_REQUEST,
        maxNodesPerHistoryReadData: NODES_PER_HISTORY_READ, maxNodesPerHistoryReadEvents: NODES_PER_HISTORY_READ,
        maxNodesPerTranslateBrowsePathsToNodeIds: NODES_PER_REQUEST, maxNodesPerNodeManagement: 1,
      },
    },
    historyServerCapabilities: { accessHistoryDataCapability: true, maxReturnDataValues: MOST_VALUES },
    maxConnectionsPerEndpoint: options.sessions * 2,
    transportSettings: {
      adjustTransportLimits: (hello: any) => ({
        maxMessageSize: Math.min(hello.maxMessageSize || MESSAGE_BYTES, MESSAGE_BYTES),
        maxChunkCount: Math.min(hello.maxChunkCount || CHUNKS, CHUNKS),
        receiveBufferSize: Math.max(8192, Math.min(hello.receiveBufferSize, CHUNK_BYTES)),
        sendBufferSize: Math.max(8192, Math.min(hello.sendBufferSize, CHUNK_BYTES)),
      }),
    },
  };
}

export async function make_server(options: Options, users: Users): Promise<OPCUAServer> {
  const manager = await certificates(options);
  const local = is_loopback(options.bind);
  const address = options.bind === "0.0.0.0" || options.bind === "::" ? hostname() : options.bind;
  const server = new OPCUAServer({
    port: options.port,
    host: options.bind,
    hostname: options.hosts[0] ?? address,
    alternateHostname: options.hosts.slice(1),
    nodeset_filename: [nodeset_file("Opc.Ua.NodeSet2")],
    serverCertificateManager: manager,
    ...(options.cert ? { certificateFile: options.cert, privateKeyFile: options.key } : { certificateFile: join(options.state, "pki/own/certs/server.pem") }),
    serverInfo: { applicationUri: `urn:indurop:opcua:${options.hosts[0] ?? hostname()}`, productUri: "urn:indurop:opcua", applicationName: { text: "InduRoP" } },
    buildInfo: { productName: "indurop-opcua", softwareVersion: VERSION, manufacturerName: "InduRoP" },
    securityModes: local ? [MessageSecurityMode.None, MessageSecurityMode.SignAndEncrypt] : [MessageSecurityMode.SignAndEncrypt],
    securityPolicies: [...(local ? [SecurityPolicy.None] : []), SecurityPolicy.Basic256Sha256, SecurityPolicy.Aes128_Sha256_RsaOaep],
    allowAnonymous: options.anonymous,
    isAuditing: false,
    discoveryServerEndpointUrl: undefined,
    userManager: {
      isValidUserAsync(this: ServerSession, user: string, password: string, done: (error: Error | null, valid?: boolean) => void) {
        users.sign_in(this, user, password).then((valid) => done(null, valid), done);
      },
      getUserRoles: (user: string) => users.roles_of(user),
    },
    ...limits(options),
  } as any);
  await server.initialize();
  refuse_user_certificates(server);
  return server;
}

// node-opcua offers signing in with a certificate in any case; who that is, `indurop serve` does not know.
function refuse_user_certificates(server: OPCUAServer): void {
  for (const description of server.endpoints.flatMap((endpoint) => endpoint.endpointDescriptions())) {
    description.userIdentityTokens = (description.userIdentityTokens ?? []).filter(({ tokenType }) => tokenType !== UserTokenType.Certificate);
  }
}

// What clients may do in the namespace of the boards: those without a role to write see a variable as read-only.
export function set_permissions(server: OPCUAServer): number {
  const namespace = server.engine.addressSpace!.registerNamespace(NAMESPACE);
  namespace.setDefaultRolePermissions([
    { roleId: WellKnownRoles.Anonymous, permissions: READ_ONLY },
    { roleId: WellKnownRoles.AuthenticatedUser, permissions: READ_ONLY },
    { roleId: WellKnownRoles.Operator, permissions: allPermissions },
  ]);
  return namespace.index;
}

export function warn_about(options: Options): void {
  if (!is_loopback(options.bind) && options.serve.protocol === "http:" && !is_loopback(options.serve.hostname)) {
    log(`passwords travel to ${options.serve.origin} as plain text: use https`);
  }
  if (!is_loopback(options.bind) && !options.cert) {
    log("the certificate is signed by the server itself; `indurop keys server NAME --opcua --host ...` makes one that clients can verify");
  }
}
