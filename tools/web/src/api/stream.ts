// SPDX-License-Identifier: Apache-2.0
// The only WebSocket of the page. A subscription lasts until its owner ends it: it survives lost connections, restarted
// nodes, and deployments that change the layout.

import { frame_of, type Frame } from "./decode";
import { token } from "./http";
import type { AlarmCounts, StreamBoard, Subscribed, ValuesFrame } from "./types";

const RETRY_MS = [250, 500, 1000, 2000];
const RESUBSCRIBE_MS = 1500;

export interface Subscription {
  board: string;
  names: string[];
  rate_hz: number;
  binary: boolean;
  subscribed?: (to: Subscribed) => void;
  values?: (frame: ValuesFrame) => void;  // binary: false
  frame?: (frame: Frame, of: Subscribed) => void;  // binary: true
  dropped?: (frames: number) => void;
  rejected?: (message: string) => void;
}

export type Link = "connecting" | "open" | "lost";

class Stream {
  private socket: WebSocket | null = null;
  private tries = 0;
  private next_id = 1;
  private readonly subscriptions = new Map<number, Subscription>();
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
      for (const id of this.subscriptions.keys()) this.send_subscribe(id);
    };
    socket.onmessage = ({ data }) => (typeof data === "string" ? this.receive_message(JSON.parse(data)) : this.receive_bytes(data));
    socket.onclose = () => {
      this.answers.clear();
      this.on_link("lost");
      setTimeout(() => this.open(), RETRY_MS[Math.min(this.tries++, RETRY_MS.length - 1)]);
    };
  }

  // The function it returns ends the subscription.
  subscribe(subscription: Subscription): () => void {
    const id = this.next_id++;
    this.subscriptions.set(id, subscription);
    this.send_subscribe(id);
    return () => {
      this.subscriptions.delete(id);
      this.answers.delete(id);
      this.send({ type: "unsubscribe", id });
    };
  }

  private send(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private send_subscribe(id: number): void {
    const subscription = this.subscriptions.get(id);
    if (!subscription) return;
    const { board, names, rate_hz, binary } = subscription;
    this.send({ type: "subscribe", id, board, names, rate_hz, binary });
  }

  private receive_message(message: any): void {
    switch (message.type) {
      case "boards": return this.on_boards(message.boards);
      case "alarms": return this.on_alarms(message.board, message);
      case "subscribed":
        if (!this.subscriptions.has(message.id)) return;
        this.answers.set(message.id, message);
        return this.subscriptions.get(message.id)?.subscribed?.(message);
      case "values": return this.for_each(message.stream, (subscription) => subscription.values?.(message));
      case "dropped": return this.for_each(message.stream, (subscription) => subscription.dropped?.(message.frames));
      case "layout_changed":
        for (const id of message.ids) {
          this.answers.delete(id);
          this.send_subscribe(id);
        }
        return;
      case "error":
        this.answers.delete(message.id);
        this.subscriptions.get(message.id)?.rejected?.(message.message);
        // A missing variable may appear when the node starts or with a deployment.
        setTimeout(() => { if (!this.answers.has(message.id)) this.send_subscribe(message.id); }, RESUBSCRIBE_MS);
    }
  }

  private receive_bytes(data: ArrayBuffer): void {
    const frame = frame_of(data);
    if (frame) this.for_each(frame.stream, (subscription, answer) => subscription.frame?.(frame, answer));
  }

  private for_each(stream: number, act: (subscription: Subscription, answer: Subscribed) => void): void {
    for (const [id, answer] of this.answers) {
      const subscription = this.subscriptions.get(id);
      if (subscription && answer.stream === stream) act(subscription, answer);
    }
  }
}

export const stream = new Stream();
