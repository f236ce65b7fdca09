// SPDX-License-Identifier: Apache-2.0
// The enabling device of ROBOT_JOG, pressed by this page: the server releases it if it receives nothing from the page.

import { board_path, message_of, post, post_until, post_without_answer } from "../../api/http";

const RENEWALS = 3;  // within the time that the server waits for one
// At most as many are open at a time: the browser sends few requests at once and keeps the others for later. On a slow
// network, the robot would still move by them after the button was released.
const MOST_OPEN = 3;

// One press, until it is released or lost.
export class Press {
  private timer = 0;
  private path = "";
  private ended = false;
  private open = 0;
  private readonly abandoned = new AbortController();

  constructor(private readonly board: string, private readonly report: (problem: string) => void) {}

  // `frame` "hand": a hand guides the robot, which needs no speed.
  async begin(request: { robot: string; frame: string; speed?: number[] }): Promise<void> {
    try {
      const { jog, keep_ns } = await post<{ jog: string; keep_ns: number }>(board_path(this.board, "/jog"), request);
      this.path = board_path(this.board, `/jog/${jog}`);
      if (this.ended) return this.release();  // released before the answer arrived
      this.timer = window.setInterval(() => void this.renew(), keep_ns / 1e6 / RENEWALS);
      void this.renew();  // the server waits since its answer, which a busy browser may have received late
    } catch (error) {
      this.ended = true;
      this.report(message_of(error));
    }
  }

  private async renew(): Promise<void> {
    if (this.open >= MOST_OPEN) return;
    this.open++;
    try {
      await post_until(`${this.path}/keep`, this.abandoned.signal);
    } catch (error) {
      if (!this.ended) this.report(message_of(error));
      this.end();
    } finally {
      this.open--;
    }
  }

  end(): void {
    if (this.ended) return;
    this.ended = true;
    clearInterval(this.timer);
    this.abandoned.abort();
    if (this.path) this.release();
  }

  private release(): void {
    post_without_answer(`${this.path}/end`);
  }
}
