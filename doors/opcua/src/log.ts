// SPDX-License-Identifier: Apache-2.0
// Messages for the people who run the program, on standard error. Clients can cause them, so their number is limited.

import { setErrorLogger, setWarningLogger } from "node-opcua";

const MOST_A_MINUTE = 60;
const MINUTE_MS = 60_000;

let begin_ms = 0;
let written = 0;
let omitted = 0;

// Names that clients send may contain line breaks and escape sequences of terminals.
function one_line(text: string): string {
  return text.replace(/[\p{Cc}\p{Cf}\p{Zl}\p{Zp}]/gu, "?");
}

export function log(text: string): void {
  const now = Date.now();
  if (now - begin_ms > MINUTE_MS) {
    if (omitted > 0) process.stderr.write(`indurop-opcua: ${omitted} further messages were omitted\n`);
    [begin_ms, written, omitted] = [now, 0, 0];
  }
  if (written++ < MOST_A_MINUTE) process.stderr.write(`indurop-opcua: ${one_line(text)}\n`);
  else omitted++;
}

export function message_of(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

// What node-opcua reports: errors, and no advice to programmers.
export function take_messages(): void {
  setWarningLogger(() => undefined);
  setErrorLogger((...words: unknown[]) => log(words.filter((word) => typeof word !== "object").map(String).join(" ").split("\n", 1)[0]));
}
