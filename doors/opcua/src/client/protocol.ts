// SPDX-License-Identifier: Apache-2.0
// Lines of JSON between the I/O module of a node (control/io/opcua_driver.cpp) and this program. The module begins with a
// Device; the answer is Ready as soon as there is a session, or a Problem. After that each Request has one Answer, or a
// Problem, after which this program closes the connection.

import type { Socket } from "node:net";

export const MOST_LINE = 4 * 1024 * 1024;

export interface Device {
  device: string;
  url: string;
  security: "encrypt" | "sign" | "none";
  user: string;
  timeout_ms: number;
  outputs: string[];  // NodeIds
  inputs: string[];
}

export interface Request {
  write: [number, string][];  // index of the output, and its number: text has all digits of 64 bits
}

export interface Ready {
  ready: true;
}

export interface Problem {
  problem: string;
}

// Of a value (docs/io.md, Quality).
export const enum Quality { Good = 1, Refused = 3, OutOfRange = 4, Reported = 6 }

export interface Answer {
  read: [Quality, string][];  // of all inputs; the text of a JSON number, or null for NaN
  written: Quality[];  // of all outputs, Good for those that were not in the request
  problem: string;  // why the first of them is not good
}

export function line_of(answer: Answer | Ready | Problem): string {
  if (!("read" in answer)) return `${JSON.stringify(answer)}\n`;
  const read = answer.read.map(([quality, number]) => `[${quality},${number}]`).join(",");
  return `{"read":[${read}],"written":${JSON.stringify(answer.written)},"problem":${JSON.stringify(answer.problem)}}\n`;
}

function is_texts(value: unknown): value is string[] {
  return Array.isArray(value) && value.every((one) => typeof one === "string");
}

// Throws if it is none.
export function device_of(line: string): Device {
  const found = JSON.parse(line) as Partial<Device>;
  if (typeof found.url !== "string" || typeof found.device !== "string" || typeof found.user !== "string" || typeof found.timeout_ms !== "number"
    || !["encrypt", "sign", "none"].includes(found.security as string) || !is_texts(found.outputs) || !is_texts(found.inputs)) {
    throw new Error("not the description of a device");
  }
  return found as Device;
}

export function request_of(line: string, outputs: number): Request {
  const found = JSON.parse(line) as Partial<Request>;
  const fits = (one: unknown): boolean => Array.isArray(one) && Number.isInteger(one[0]) && one[0] >= 0 && one[0] < outputs && typeof one[1] === "string";
  if (!Array.isArray(found.write) || !found.write.every(fits)) throw new Error("not a request");
  return found as Request;
}

// The lines that come, one after the other; ends with the connection. Throws for one that is too long.
export async function* lines_of(socket: Socket): AsyncGenerator<string> {
  let text = "";
  socket.setEncoding("utf8");
  for await (const part of socket) {
    text += part as string;
    for (let end = text.indexOf("\n"); end >= 0; end = text.indexOf("\n")) {
      yield text.slice(0, end);
      text = text.slice(end + 1);
    }
    if (text.length > MOST_LINE) throw new Error("a line is too long");
  }
}
