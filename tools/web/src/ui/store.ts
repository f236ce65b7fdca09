// SPDX-License-Identifier: Apache-2.0
// A value that components look at, and the two ways they get one: from a store, or by asking the server again and again.

import { useEffect, useRef, useState } from "preact/hooks";

export class Store<T> {
  private readonly listeners = new Set<() => void>();
  constructor(private now: T) {}
  get(): T { return this.now; }
  set(next: T): void {
    this.now = next;
    for (const listener of [...this.listeners]) listener();
  }
  listen(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}

export function useStore<T>(store: Store<T>): T {
  const [value, set] = useState(store.get());
  useEffect(() => {
    set(() => store.get());
    return store.listen(() => set(() => store.get()));
  }, [store]);
  return value;
}

export interface Asked<T> {
  value: T | null;
  error: string;
  again: () => void;
}

// Set when whoever asks should not wait for the next turn: the server is back.
export const turned = new Store(0);

// Asks at once and then every `every_ms`, never while the question before is still open or nobody sees the page. `key`
// names what is asked: another key forgets the value; an empty one asks nothing.
export function useAsked<T>(key: string, every_ms: number, ask: () => Promise<T>, words: (error: unknown) => string): Asked<T> {
  const [state, set] = useState<{ key: string; value: T | null; error: string }>({ key, value: null, error: "" });
  const latest = useRef(ask);
  latest.current = ask;
  const now = useRef<() => void>(() => {});
  useEffect(() => {
    if (!key) return;
    let ended = false;
    let timer = 0;
    let open = false;
    let wanted = false;  // meanwhile
    const turn = async () => {
      clearTimeout(timer);
      wanted = open;
      if (open || ended) return;
      if (!document.hidden) {
        open = true;
        try {
          const value = await latest.current();
          if (!ended) set({ key, value, error: "" });
        } catch (error) {
          if (!ended) set((before) => ({ key, value: before.key === key ? before.value : null, error: words(error) }));
        }
        open = false;
      }
      if (wanted) void turn();
      else if (!ended && every_ms) timer = window.setTimeout(turn, every_ms);
    };
    now.current = () => void turn();
    void turn();
    const seen = () => { if (!document.hidden) void turn(); };
    const deaf = turned.listen(seen);
    document.addEventListener("visibilitychange", seen);
    return () => {
      ended = true;
      clearTimeout(timer);
      deaf();
      document.removeEventListener("visibilitychange", seen);
    };
  }, [key, every_ms]);
  const mine = state.key === key;
  return { value: mine ? state.value : null, error: mine ? state.error : "", again: () => now.current() };
}
