// SPDX-License-Identifier: Apache-2.0
// Requests to `indurop serve`. A request that fails or is refused throws a Refused with the server's message.

import { readFileSync } from "node:fs";
import http from "node:http";
import https from "node:https";

const TIMEOUT_MS = 15_000;
const MOST_SOCKETS = 8;

export const status = { bad_request: 400, unauthorized: 401, forbidden: 403, not_found: 404, conflict: 409, wrong_value: 422, locked: 423, unavailable: 503, no_answer: 504 };

export class Refused extends Error {
  // code: HTTP status, 0: the server does not answer.
  constructor(readonly code: number, message: string) {
    super(message);
  }
}

// First line of a token file, `NAME TOKEN`, as of `indurop serve --token-file`.
export function read_token(file: string): string {
  const [, token] = readFileSync(file, "utf8").split("\n", 1)[0].trim().split(/\s+/);
  if (!token) throw new Error(`${file}:1: the first line is not NAME TOKEN`);
  return token;
}

export class ServeClient {
  readonly ca: Buffer | undefined;
  private readonly agent: http.Agent;

  constructor(readonly base: URL, ca_file: string, readonly token: string) {
    this.ca = ca_file ? readFileSync(ca_file) : undefined;
    const settings = { keepAlive: true, maxSockets: MOST_SOCKETS };
    this.agent = base.protocol === "https:" ? new https.Agent({ ...settings, ca: this.ca }) : new http.Agent(settings);
  }

  // token: that of a user; without one that of this program.
  get<T>(path: string, token?: string): Promise<T> {
    return this.request<T>("GET", path, undefined, token);
  }

  // The same with times in ns as texts: numbers of JavaScript would round them.
  get_exact<T>(path: string): Promise<T> {
    return this.request<T>("GET", path, undefined, undefined, (text) => text.replace(/"(\w+_ns)": ?(-?\d+)/g, '"$1":"$2"'));
  }

  post<T>(path: string, body?: unknown, token?: string): Promise<T> {
    return this.request<T>("POST", path, body === undefined ? undefined : JSON.stringify(body), token);
  }

  private request<T>(method: string, path: string, body: string | undefined, token = this.token,
    prepare: (text: string) => string = (text) => text): Promise<T> {
    const headers: Record<string, string> = { Accept: "application/json" };
    if (token) headers.Authorization = `Bearer ${token}`;
    if (body !== undefined) headers["Content-Type"] = "application/json";
    headers["Content-Length"] = `${Buffer.byteLength(body ?? "")}`;
    const send = this.base.protocol === "https:" ? https.request : http.request;
    return new Promise<T>((resolve, reject) => {
      const request = send(new URL(`/api/v1/${path}`, this.base), { method, headers, agent: this.agent, timeout: TIMEOUT_MS }, (answer) => {
        const parts: Buffer[] = [];
        answer.on("data", (part: Buffer) => parts.push(part));
        answer.on("error", (error) => reject(new Refused(0, error.message)));
        answer.on("end", () => {
          try {
            resolve(body_of<T>(answer.statusCode ?? 0, prepare(Buffer.concat(parts).toString())));
          } catch (error) {
            reject(error);
          }
        });
      });
      request.on("timeout", () => request.destroy(new Error("no answer in time")));
      request.on("error", (error) => reject(new Refused(0, `${this.base.origin} does not answer: ${error.message}`)));
      request.end(body);
    });
  }
}

function body_of<T>(code: number, text: string): T {
  let body: any;
  try {
    body = JSON.parse(text);
  } catch {
    throw new Refused(code, `the server's answer is not JSON (status ${code})`);
  }
  if (code < 200 || code > 299) throw new Refused(code, [body.message ?? `status ${code}`, ...(body.details ?? [])].join(" "));
  return body as T;
}

export function board_path(board: string, rest = ""): string {
  return `boards/${encodeURIComponent(board)}${rest}`;
}
