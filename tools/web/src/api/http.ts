// SPDX-License-Identifier: Apache-2.0
// Requests to the server. A request that fails or is rejected throws a RequestError with the server's message.

const TOKEN_KEY = "indurop.token";
const REJECTED_KEY = "indurop.rejected";  // the server rejected the token of this tab
const UNAUTHORIZED = 401;
const TIMEOUT_MS = 8000;
const IDLE_MS = 60_000;  // a user who has touched nothing for this time has not caused what the page requests

let touched_ms = Date.now();
for (const what of ["pointerdown", "pointermove", "keydown", "wheel"]) {
  window.addEventListener(what, () => { touched_ms = Date.now(); }, { capture: true, passive: true });
}

// The page requests much on its own. Without a user, this must not keep his session alive.
function add_background(headers: Record<string, string>): void {
  if (Date.now() - touched_ms > IDLE_MS) headers["Indurop-Background"] = "true";
}

export class RequestError extends Error {
  constructor(readonly status: number, message: string, readonly details: string[] = []) {
    super(message);
  }
  // The server answers, but requires a token.
  get unauthorized(): boolean { return this.status === UNAUTHORIZED; }
}

// Moves `#token=...` from the address, which users copy and photograph, to the storage of this tab. False: there is none.
export function take_token_from_address(): boolean {
  const found = /(?:^#|&)token=([A-Za-z0-9_-]+)/.exec(location.hash);
  if (!found) return false;
  sessionStorage.setItem(TOKEN_KEY, found[1]);
  sessionStorage.removeItem(REJECTED_KEY);
  const rest = location.hash.replace(/(^#|&)token=[A-Za-z0-9_-]+/, "").replace(/^&/, "");
  history.replaceState(null, "", location.pathname + (rest ? (rest.startsWith("#") ? rest : `#${rest}`) : ""));
  window.dispatchEvent(new HashChangeEvent("hashchange"));  // replaceState does not dispatch it
  return true;
}

export function token(): string {
  return sessionStorage.getItem(TOKEN_KEY) ?? "";
}

// Keeps the token for this tab; an empty one: none.
export function set_token(fresh: string): void {
  sessionStorage.removeItem(REJECTED_KEY);
  if (fresh) sessionStorage.setItem(TOKEN_KEY, fresh);
  else sessionStorage.removeItem(TOKEN_KEY);
}

// The server rejected the token of this page. The page continues without one: reading may need none.
export function token_was_rejected(): boolean {
  return sessionStorage.getItem(REJECTED_KEY) !== null;
}

function discard_token(rejected: string): void {
  if (!rejected || rejected !== token()) return;
  sessionStorage.removeItem(TOKEN_KEY);
  sessionStorage.setItem(REJECTED_KEY, "1");
}

async function request<T>(path: string, more: RequestInit, timeout_ms = TIMEOUT_MS): Promise<T> {
  const headers: Record<string, string> = { Accept: "application/json" };
  const sent = token();
  if (sent) headers.Authorization = `Bearer ${sent}`;
  if (more.body) headers["Content-Type"] = "application/json";
  add_background(headers);
  let answer: Response;
  try {
    answer = await fetch(`/api/v1/${path}`, { signal: AbortSignal.timeout(timeout_ms), ...more, headers, cache: "no-store" });
  } catch {
    throw new RequestError(0, "The server does not answer.");
  }
  if (answer.status === UNAUTHORIZED) discard_token(sent);
  const text = await answer.text();
  let body: any;
  try {
    body = JSON.parse(text);
  } catch {
    throw new RequestError(answer.status, `The server's answer is not JSON (status ${answer.status}).`);
  }
  if (!answer.ok) throw new RequestError(answer.status, body.message ?? `Rejected (status ${answer.status}).`, body.details ?? []);
  return body as T;
}

export function get<T>(path: string, timeout_ms?: number): Promise<T> {
  return request<T>(path, { method: "GET" }, timeout_ms);
}

export function post<T>(path: string, body?: unknown, timeout_ms?: number): Promise<T> {
  return request<T>(path, { method: "POST", body: body === undefined ? undefined : JSON.stringify(body) }, timeout_ms);
}

// Until `abandoned`, however long it takes.
export function post_until<T>(path: string, abandoned: AbortSignal): Promise<T> {
  return request<T>(path, { method: "POST", signal: abandoned });
}

// For a page that is being closed: it cannot receive the answer.
export function post_without_answer(path: string): void {
  const headers: Record<string, string> = token() ? { Authorization: `Bearer ${token()}` } : {};
  void fetch(`/api/v1/${path}`, { method: "POST", headers, keepalive: true }).catch(() => undefined);
}

export function board_path(board: string, rest = ""): string {
  return `boards/${encodeURIComponent(board)}${rest}`;
}

export function message_of(error: unknown): string {
  if (error instanceof RequestError) return [error.message, ...error.details].join(" ");
  return error instanceof Error ? error.message : String(error);
}
