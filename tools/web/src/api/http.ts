// SPDX-License-Identifier: Apache-2.0
// Questions and orders over HTTP. What the server refuses becomes a Refusal with the server's words.

const TOKEN_KEY = "indurop.token";
const REFUSED_KEY = "indurop.refused";  // the token that was here is not the server's
const UNAUTHORIZED = 401;
const PATIENCE_MS = 8000;

export class Refusal extends Error {
  constructor(readonly status: number, message: string, readonly details: string[] = []) {
    super(message);
  }
  // The server is there and does not let this page look.
  get unauthorized(): boolean { return this.status === UNAUTHORIZED; }
}

// `#token=...` of the address is kept for this tab and taken out of the address, which people copy and photograph. False:
// there is none.
export function take_token_from_address(): boolean {
  const found = /(?:^#|&)token=([A-Za-z0-9_-]+)/.exec(location.hash);
  if (!found) return false;
  sessionStorage.setItem(TOKEN_KEY, found[1]);
  sessionStorage.removeItem(REFUSED_KEY);
  const rest = location.hash.replace(/(^#|&)token=[A-Za-z0-9_-]+/, "").replace(/^&/, "");
  history.replaceState(null, "", location.pathname + (rest ? (rest.startsWith("#") ? rest : `#${rest}`) : ""));
  window.dispatchEvent(new HashChangeEvent("hashchange"));  // which replaceState does not say
  return true;
}

export function token(): string {
  return sessionStorage.getItem(TOKEN_KEY) ?? "";
}

// This page had a token that the server does not know. It is not shown again: without one a page may still look.
export function token_was_refused(): boolean {
  return sessionStorage.getItem(REFUSED_KEY) !== null;
}

function forget(refused: string): void {
  if (!refused || refused !== token()) return;
  sessionStorage.removeItem(TOKEN_KEY);
  sessionStorage.setItem(REFUSED_KEY, "1");
}

async function ask<T>(path: string, more: RequestInit, patience_ms = PATIENCE_MS): Promise<T> {
  const headers: Record<string, string> = { Accept: "application/json" };
  const shown = token();
  if (shown) headers.Authorization = `Bearer ${shown}`;
  if (more.body) headers["Content-Type"] = "application/json";
  let answer: Response;
  try {
    answer = await fetch(`/api/v1/${path}`, { ...more, headers, cache: "no-store", signal: AbortSignal.timeout(patience_ms) });
  } catch {
    throw new Refusal(0, "The server does not answer.");
  }
  if (answer.status === UNAUTHORIZED) forget(shown);
  const text = await answer.text();
  let body: any;
  try {
    body = JSON.parse(text);
  } catch {
    throw new Refusal(answer.status, `The server's answer is no JSON (status ${answer.status}).`);
  }
  if (!answer.ok) throw new Refusal(answer.status, body.message ?? `Refused (status ${answer.status}).`, body.details ?? []);
  return body as T;
}

export function get<T>(path: string, patience_ms?: number): Promise<T> {
  return ask<T>(path, { method: "GET" }, patience_ms);
}

export function post<T>(path: string, body?: unknown, patience_ms?: number): Promise<T> {
  return ask<T>(path, { method: "POST", body: body === undefined ? undefined : JSON.stringify(body) }, patience_ms);
}

// For a page that is being closed: nobody hears the answer.
export function post_at_the_end(path: string): void {
  const headers: Record<string, string> = token() ? { Authorization: `Bearer ${token()}` } : {};
  void fetch(`/api/v1/${path}`, { method: "POST", headers, keepalive: true }).catch(() => undefined);
}

export function board_path(board: string, rest = ""): string {
  return `boards/${encodeURIComponent(board)}${rest}`;
}

export function words(error: unknown): string {
  if (error instanceof Refusal) return [error.message, ...error.details].join(" ");
  return error instanceof Error ? error.message : String(error);
}
