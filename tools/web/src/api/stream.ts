// SPDX-License-Identifier: Apache-2.0
// The one WebSocket of the page. A subscription lives until its owner ends it: through lost connections, nodes that go
// and come, and deployments that change the layout.

import { frame_of, type Frame } from "./decode";
import { token } from "./http";
import type { AlarmCounts, StreamBoard, Subscribed, ValuesFrame } from "./types";

const RETRY_MS = [250, 500, 1000, 2000];
const RESUBSCRIBE_MS = 1500;

export interface Wanted {
  board: string;
  names: string[];
  rate_hz: number;
  binary: boolean;
  subscribed?: (to: Subscribed) => void;
  values?: (frame: ValuesFrame) => void;  // binary: false
  frame?: (frame: Frame, of: Subscribed) => void;  // binary: true
  dropped?: (frames: number) => void;
  refused?: (message: string) => void;
}

export type Link = "connecting" | "open" | "lost";

class Stream {
  private socket: WebSocket | null = null;
  private tries = 0;
  private next_id = 1;
  private readonly wanted = new Map<number, Wanted>();
  private readonly answers = new Map<number, Subscribed>();
  on_link: (link: Link) => void = () => {};
  on_boards: (boards: StreamBoard[]) => void = () => {};
  on_alarms: (board: string, counts: AlarmCounts) => void = () => {};

  open(): void {
    const protocols = ["indurop.v1"];
    if (token()) protocols.push(`indurop.token.${token()}`);
    const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/v1/stream`, protocols);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      this.tries = 0;
      this.on_link("open");
      for (const id of this.wanted.keys()) this.ask(id);
    };
    socket.onmessage = ({ data }) => (typeof data === "string" ? this.said(JSON.parse(data)) : this.bytes(data));
    socket.onclose = () => {
      this.answers.clear();
      this.on_link("lost");
      setTimeout(() => this.open(), RETRY_MS[Math.min(this.tries++, RETRY_MS.length - 1)]);
    };
  }

  // Returns what ends it.
  subscribe(wanted: Wanted): () => void {
    const id = this.next_id++;
    this.wanted.set(id, wanted);
    this.ask(id);
    return () => {
      this.wanted.delete(id);
      this.answers.delete(id);
      this.send({ type: "unsubscribe", id });
    };
  }

  private send(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private ask(id: number): void {
    const wanted = this.wanted.get(id);
    if (!wanted) return;
    const { board, names, rate_hz, binary } = wanted;
    this.send({ type: "subscribe", id, board, names, rate_hz, binary });
  }

  private said(message: any): void {
    switch (message.type) {
      case "boards": return this.on_boards(message.boards);
      case "alarms": return this.on_alarms(message.board, message);
      case "subscribed":
        if (!this.wanted.has(message.id)) return;
        this.answers.set(message.id, message);
        return this.wanted.get(message.id)?.subscribed?.(message);
      case "values": return this.each(message.stream, (wanted) => wanted.values?.(message));
      case "dropped": return this.each(message.stream, (wanted) => wanted.dropped?.(message.frames));
      case "layout_changed":
        for (const id of message.ids) {
          this.answers.delete(id);
          this.ask(id);
        }
        return;
      case "error":
        this.answers.delete(message.id);
        this.wanted.get(message.id)?.refused?.(message.message);
        // What is missing now may come with the node or with a deployment.
        setTimeout(() => { if (!this.answers.has(message.id)) this.ask(message.id); }, RESUBSCRIBE_MS);
    }
  }

  private bytes(data: ArrayBuffer): void {
    const frame = frame_of(data);
    if (frame) this.each(frame.stream, (wanted, answer) => wanted.frame?.(frame, answer));
  }

  private each(stream: number, what: (wanted: Wanted, answer: Subscribed) => void): void {
    for (const [id, answer] of this.answers) {
      const wanted = this.wanted.get(id);
      if (wanted && answer.stream === stream) what(wanted, answer);
    }
  }
}

export const stream = new Stream();
