// SPDX-License-Identifier: Apache-2.0
// Methods: each is a call of a shared function at `indurop serve`, with the token of the session's user.

import { StatusCodes, type CallMethodResultOptions, type ISessionContext, type StatusCode } from "node-opcua";

import { log, message_of } from "../log";
import { text_of, variant_at, type Construct } from "../model/values";
import { board_path, Refused, status, type ServeClient } from "../serve/http";
import type { CallFunction } from "../space/methods";
import { code_of } from "./write";
import type { Users } from "./users";

function code_of_call(error: unknown): StatusCode {
  if (!(error instanceof Refused)) return code_of(error);
  switch (error.code) {
    case status.wrong_value: return StatusCodes.BadInvalidArgument;
    case status.conflict: return StatusCodes.BadNotImplemented;
    case status.unavailable: return StatusCodes.BadResourceUnavailable;
    default: return code_of(error);
  }
}

export function make_call(client: ServeClient, users: Users, construct: Construct): CallFunction {
  return async (board, one, words, context: ISessionContext): Promise<CallMethodResultOptions> => {
    const who = users.name_of(context.session);
    try {
      const token = users.token_of(context.session);
      if (token === undefined) throw new Refused(status.forbidden, "sign in with a name and a password to call methods");
      const values = Object.fromEntries(one.arguments.map((word, i) => [word.name, text_of(words[i].value, word.form)]));
      const answer = await client.post<{ result: string | null }>(
        board_path(board, `/functions/${encodeURIComponent(one.name)}/call`), { arguments: values, reason: "OPC UA", values: "bytes" }, token);
      const outputArguments = one.result ? [variant_at(Buffer.from(answer.result ?? "", "hex"), 0, one.result, construct)] : [];
      return { statusCode: StatusCodes.Good, outputArguments };
    } catch (error) {
      log(`${board}/${one.name}: the call of ${who} was refused: ${message_of(error)}`);
      return { statusCode: code_of_call(error) };
    }
  };
}
