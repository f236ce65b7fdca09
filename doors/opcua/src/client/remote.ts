// SPDX-License-Identifier: Apache-2.0
// A session with the server of a device: connect, then exchange in each cycle.

import {
  AttributeIds, MessageSecurityMode, OPCUAClient, resolveNodeId, SecurityPolicy, UserTokenType,
  type ClientSession, type DataType, type NodeId, type OPCUACertificateManager, type StatusCode, type WriteValueOptions,
} from "node-opcua";

import { message_of } from "../log";
import { quality_of, read_number, variant_of } from "./numbers";
import { Quality, type Answer, type Device, type Request } from "./protocol";

const NODES_PER_REQUEST = 500;  // fewer than servers have as their limit
const SESSION_MS = 10_000;  // after a crash of this program, its session does not stay longer
const MODES = { encrypt: MessageSecurityMode.SignAndEncrypt, sign: MessageSecurityMode.Sign, none: MessageSecurityMode.None };

// Certificates of servers: trusted are those in trusted/certs.
export type Trust = OPCUACertificateManager;

async function in_parts<T, R>(all: T[], each: (part: T[]) => Promise<R[]>): Promise<R[]> {
  const results: R[] = [];
  for (let begin = 0; begin < all.length; begin += NODES_PER_REQUEST) results.push(...await each(all.slice(begin, begin + NODES_PER_REQUEST)));
  return results;
}

export class Remote {
  readonly #device: Device;
  readonly #client: OPCUAClient;
  #session!: ClientSession;
  #inputs: (NodeId | undefined)[] = [];
  #outputs: (NodeId | undefined)[] = [];
  #types: (DataType | undefined)[] = [];  // of the outputs

  private constructor(device: Device, trust: Trust) {
    this.#device = device;
    this.#client = OPCUAClient.create({
      applicationName: "InduRoP", applicationUri: "urn:indurop:opcua:client", endpointMustExist: false, securityMode: MODES[device.security],
      securityPolicy: device.security === "none" ? SecurityPolicy.None : SecurityPolicy.Basic256Sha256, clientCertificateManager: trust,
      connectionStrategy: { maxRetry: 0 }, requestedSessionTimeout: SESSION_MS, defaultTransactionTimeout: Math.max(device.timeout_ms, 1000),
      keepSessionAlive: true,
    });
  }

  // Throws if there is no session. `password` is that of the device's user.
  static async connect(device: Device, trust: Trust, password: string): Promise<Remote> {
    const remote = new Remote(device, trust);
    try {
      await remote.#client.connect(device.url);
      const identity = device.user ? { type: UserTokenType.UserName, userName: device.user, password } as const : undefined;
      remote.#session = await remote.#client.createSession(identity);
      await remote.#find_nodes();
    } catch (error) {
      await remote.close();
      throw error;
    }
    return remote;
  }

  async #find_nodes(): Promise<void> {
    const spaces = await this.#session.readNamespaceArray();
    const node_of = (text: string): NodeId | undefined => {
      const [, uri, rest] = /^nsu=([^;]*);(.*)$/u.exec(text) ?? [];
      if (uri === undefined) return resolveNodeId(text);
      return spaces.includes(uri) ? resolveNodeId(`ns=${spaces.indexOf(uri)};${rest}`) : undefined;
    };
    this.#inputs = this.#device.inputs.map(node_of);
    this.#outputs = this.#device.outputs.map(node_of);
    this.#types = [];
    for (const node of this.#outputs) {
      this.#types.push(node ? await this.#session.getBuiltInDataType(node).catch(() => undefined) : undefined);
    }
  }

  // Writes, then reads all inputs. Throws if the server does not answer.
  async exchange({ write }: Request): Promise<Answer> {
    const problems: string[] = [];
    const written: Quality[] = this.#outputs.map(() => Quality.Good);
    const note = (verb: string, name: string, reason: string): void => void problems.push(`${verb} ${name}: ${reason}`);
    const values: { index: number; fits: boolean; value: WriteValueOptions }[] = [];
    for (const [index, text] of write) {
      const [node, type] = [this.#outputs[index], this.#types[index]];
      const made = node && type !== undefined ? variant_of(text, type) : undefined;
      if (node && made) {
        values.push({ index, fits: made.fits, value: { nodeId: node, attributeId: AttributeIds.Value, value: { value: made.variant } } });
      } else {
        written[index] = Quality.Refused;
        note("writing", this.#device.outputs[index], "the server has no number there");
      }
    }
    const codes = await in_parts(values, async (part) => await this.#session.write(part.map(({ value }) => value)) as StatusCode[]);
    values.forEach(({ index, fits }, i) => {
      written[index] = codes[i].isGood() && !fits ? Quality.OutOfRange : quality_of(codes[i]);
      if (written[index] !== Quality.Good) note("writing", this.#device.outputs[index], fits ? codes[i].name : "it was limited to the range of its type");
    });
    return { read: await this.#read(note), written, problem: problems[0] ?? "" };
  }

  async #read(note: (verb: string, name: string, reason: string) => void): Promise<[Quality, string][]> {
    const known = this.#inputs.filter((node): node is NodeId => node !== undefined);
    const found = await in_parts(known, async (part) => await this.#session.read(part.map((nodeId) => ({ nodeId, attributeId: AttributeIds.Value }))));
    let next = 0;
    return this.#inputs.map((node, i) => {
      const value = node ? found[next++] : undefined;
      const pair: [Quality, string] = value ? read_number(value) : [Quality.Refused, "0"];
      if (pair[0] !== Quality.Good) {
        note("reading", this.#device.inputs[i], !value ? "the server has no such namespace" : value.statusCode.isGood() ? "it is no single number" : value.statusCode.name);
      }
      return pair;
    });
  }

  async close(): Promise<void> {
    await this.#session?.close().catch(() => undefined);
    await this.#client.disconnect().catch(() => undefined);
  }
}

export function reason_of(error: unknown, device: Device): string {
  return `${device.url}: ${message_of(error).split("\n", 1)[0]}`;
}
