// SPDX-License-Identifier: Apache-2.0
// Writes: each is a `set` at `indurop serve`, with the token of the session's user. Role, ranges, forces and the write lock
// are checked there, and its journal has the name.

import { AttributeIds, DataType, NumericRange, StatusCodes, VariantArrayType, type DataValue, type SessionContext, type StatusCode, type UAVariable, type Variant } from "node-opcua";

import { log, message_of } from "../log";
import { built_in, text_of, WrongType } from "../model/values";
import type { Part } from "../model/part";
import { board_path, Refused, status, type ServeClient } from "../serve/http";
import type { WriteAttribute } from "../space/internals";
import type { PartNode } from "../space/variable";
import type { Users } from "./users";

export function code_of(error: unknown): StatusCode {
  if (error instanceof WrongType) return StatusCodes.BadTypeMismatch;
  if (!(error instanceof Refused)) return StatusCodes.BadInternalError;
  switch (error.code) {
    case 0: return StatusCodes.BadNoCommunication;
    case status.unauthorized:
    case status.forbidden: return StatusCodes.BadUserAccessDenied;
    case status.not_found: return StatusCodes.BadNodeIdUnknown;
    case status.wrong_value: return StatusCodes.BadOutOfRange;
    case status.locked: return StatusCodes.BadLocked;
    case status.no_answer: return StatusCodes.BadTimeout;
    default: return StatusCodes.BadInvalidState;
  }
}

// Throws WrongType.
function check_type(value: Variant, part: Part, whole: boolean): void {
  if (value.dataType !== built_in(part.form)) throw new WrongType(`a ${DataType[built_in(part.form)]} is wanted, not a ${DataType[value.dataType]}`);
  const rank = part.form.dims?.length ?? 0;
  const given = value.arrayType === VariantArrayType.Scalar ? 0 : value.arrayType === VariantArrayType.Array ? 1 : value.dimensions?.length ?? 0;
  if (given !== rank) throw new WrongType(`${rank} dimensions are wanted, not ${given}`);
  if (whole && rank > 1 && JSON.stringify(value.dimensions) !== JSON.stringify(part.form.dims)) {
    throw new WrongType(`the dimensions are ${part.form.dims!.join(", ")}`);
  }
}

// Texts by name: of the whole value, or of the elements of an index range.
function texts_of(part: Part, value: Variant, range: NumericRange): Record<string, string> {
  if (!range || range.isEmpty()) {
    check_type(value, part, true);
    return { [part.path]: text_of(value.value, part.form) };
  }
  check_type(value, part, false);
  const bounds = /^(\d+)(?::(\d+))?$/.exec(range.toEncodeableString() ?? "");
  if (!bounds || part.form.dims?.length !== 1) throw new WrongType("an index range is written in arrays of one dimension only");
  const first = Number(bounds[1]);
  const last = Number(bounds[2] ?? bounds[1]);
  const elements = value.value as ArrayLike<unknown>;
  if (elements.length !== last - first + 1) throw new WrongType(`${last - first + 1} elements are wanted`);
  const { dims: _, ...form } = part.form;
  return Object.fromEntries(Array.from(elements, (element, i) => [`${part.path}[${first + i}]`, text_of(element, form)]));
}

export function make_write(client: ServeClient, users: Users, by_node: Map<string, PartNode>): WriteAttribute {
  const write = async (node: UAVariable, context: SessionContext, value: DataValue, range: NumericRange): Promise<StatusCode> => {
    const one = by_node.get(node.nodeId.toString());
    if (!one || one.variable.gone) return StatusCodes.BadNodeIdUnknown;
    const token = users.token_of(context.session);
    const who = users.name_of(context.session);
    try {
      if (token === undefined) throw new Refused(status.forbidden, "sign in with a name and a password to write");
      const values = texts_of(one.part, value.value, NumericRange.coerce(range));
      await client.post(board_path(one.variable.board, "/set"), { values, reason: "OPC UA" }, token);
      return StatusCodes.Good;
    } catch (error) {
      log(`${one.variable.board}/${one.part.path}: the write of ${who} was refused: ${message_of(error)}`);
      return code_of(error);
    }
  };
  return function write_attribute(this: UAVariable, context, { attributeId, value, indexRange }, done): void {
    if (attributeId !== AttributeIds.Value) {
      done(null, StatusCodes.BadNotWritable);
      return;
    }
    write(this, context, value, indexRange).then((code) => done(null, code), (error) => done(error, StatusCodes.BadInternalError));
  };
}
