// SPDX-License-Identifier: Apache-2.0
// A value that components show, from one of two sources: a store, or repeated requests to the server.

import { useEffect, useRef, useState } from "preact/hooks";
import { message_of } from "../api/http";

export class Store<T> {
  private readonly listeners = new Set<() => void>();
  constructor(private value: T) {}
  get(): T { return this.value; }
  set(next: T): void {
    this.value = next;
    for (const listener of [...this.listeners]) listener();
  }
  listen(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}

export function useStore<T>(store: Store<T>): T {
  const [value, set_value] = useState(store.get());
  useEffect(() => {
    set_value(() => store.get());
    return store.listen(() => set_value(() => store.get()));
  }, [store]);
  return value;
}

export interface Requested<T> {
  value: T | null;
  error: string;
  refresh: () => void;
}

// Changes when the server can be reached again: then requests are sent at once.
export const reconnected = new Store(0);

// Sends a request at once and then every `every_ms` (0: once), never while the previous one is open or the page is hidden.
// `key` identifies the request: another key discards the value, with an empty key no request is sent.
export function useRequest<T>(key: string, every_ms: number, send: () => Promise<T>): Requested<T> {
  const [state, set_state] = useState<{ key: string; value: T | null; error: string }>({ key, value: null, error: "" });
  const latest = useRef(send);
  latest.current = send;
  const poll_now = useRef<() => void>(() => {});
  useEffect(() => {
    if (!key) return;
    let ended = false;
    let timer = 0;
    let open = false;
    let answered = false;
    let repeat = false;  // requested while one was open
    const poll = async () => {
      clearTimeout(timer);
      repeat = open;
      if (open || ended) return;
      if (!document.hidden) {
        open = true;
        try {
          const value = await latest.current();
          answered = true;
          if (!ended) set_state({ key, value, error: "" });
        } catch (error) {
          if (!ended) set_state((before) => ({ key, value: before.key === key ? before.value : null, error: message_of(error) }));
        }
        open = false;
      }
      if (repeat) void poll();
      else if (!ended && every_ms) timer = window.setTimeout(poll, every_ms);
    };
    poll_now.current = () => void poll();
    void poll();
    const poll_if_visible = () => { if (!document.hidden) void poll(); };
    const stop_listening = reconnected.listen(poll_if_visible);
    // What is requested once is not requested again when the page is shown again.
    const poll_when_shown = () => { if (every_ms || !answered) poll_if_visible(); };
    document.addEventListener("visibilitychange", poll_when_shown);
    return () => {
      ended = true;
      clearTimeout(timer);
      stop_listening();
      document.removeEventListener("visibilitychange", poll_when_shown);
    };
  }, [key, every_ms]);
  const current = state.key === key;
  return { value: current ? state.value : null, error: current ? state.error : "", refresh: () => poll_now.current() };
}
