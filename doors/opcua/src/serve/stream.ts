// SPDX-License-Identifier: Apache-2.0
// The WebSocket to `indurop serve`: it is opened again whenever it is lost. Who subscribed does so again on `opened`.

import WebSocket from "ws";

import type { ServeClient } from "./http";
import type { StreamBoard, Subscribed } from "./types";

const RETRY_MS = [250, 500, 1000, 2000];
const SILENCE_MS = 60_000;
const HEADER = 40;

// A binary frame of docs/serve.md.
export interface Frame {
  stream: number;
  alive: boolean;
  wall_ms: number;
  bytes: Buffer;
}

export interface StreamEvents {
  opened(): void;
  lost(why: string): void;
  boards(boards: StreamBoard[]): void;
  alarms(board: string): void;
  subscribed(answer: Subscribed): void;
  frame(frame: Frame): void;
  ended(ids: number[]): void;  // their layout has changed
  rejected(id: number, message: string): void;
}

// null: not a frame of values, or of an unknown version.
export function frame_of(bytes: Buffer): Frame | null {
  if (bytes.length < HEADER || bytes[0] !== 1 || bytes[1] !== 1) return null;
  return {
    stream: bytes.readUInt32LE(4),
    alive: (bytes.readUInt16LE(2) & 1) !== 0,
    wall_ms: Number(bytes.readBigInt64LE(24) / 1_000_000n),
    bytes,
  };
}

export class Stream {
  private socket: WebSocket | null = null;
  private tries = 0;
  private closed = false;
  private silence: NodeJS.Timeout | undefined;

  constructor(private readonly client: ServeClient, private readonly events: StreamEvents) {}

  open(): void {
    const { base, ca, token } = this.client;
    const url = new URL("/api/v1/stream", base);
    url.protocol = base.protocol === "https:" ? "wss:" : "ws:";
    const protocols = token ? ["indurop.v1", `indurop.token.${token}`] : ["indurop.v1"];
    const socket = new WebSocket(url, protocols, { ca, perMessageDeflate: false, skipUTF8Validation: true });
    this.socket = socket;
    let why = "closed by the server";
    socket.on("open", () => {
      this.tries = 0;
      this.events.opened();
    });
    socket.on("message", (data: Buffer, binary: boolean) => this.receive(data, binary));
    socket.on("ping", () => this.hear());
    socket.on("error", (error) => { why = error.message; });
    socket.on("close", () => {
      clearTimeout(this.silence);
      if (this.closed) return;
      this.events.lost(why);
      setTimeout(() => { if (!this.closed) this.open(); }, RETRY_MS[Math.min(this.tries++, RETRY_MS.length - 1)]);
    });
    this.hear();
  }

  close(): void {
    this.closed = true;
    clearTimeout(this.silence);
    this.socket?.terminate();
  }

  subscribe(id: number, board: string, names: string[], rate_hz: number): void {
    this.send({ type: "subscribe", id, board, names, rate_hz, binary: true });
  }

  unsubscribe(id: number): void {
    this.send({ type: "unsubscribe", id });
  }

  private send(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  // A connection whose other end has vanished is opened again: the server pings every client.
  private hear(): void {
    clearTimeout(this.silence);
    this.silence = setTimeout(() => this.socket?.terminate(), SILENCE_MS);
  }

  private receive(data: Buffer, binary: boolean): void {
    this.hear();
    if (binary) {
      const frame = frame_of(data);
      if (frame) this.events.frame(frame);
      return;
    }
    const message = JSON.parse(data.toString());
    switch (message.type) {
      case "boards": return this.events.boards(message.boards);
      case "alarms": return this.events.alarms(message.board);
      case "subscribed": return this.events.subscribed(message);
      case "layout_changed": return this.events.ended(message.ids);
      case "error": if (message.id !== null) this.events.rejected(message.id, message.message);
    }
  }
}
