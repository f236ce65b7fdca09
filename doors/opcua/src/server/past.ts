// SPDX-License-Identifier: Apache-2.0
// Values of the past: what the history of `indurop serve` has, as values of OPC UA with the times of the runs that wrote them.

import { DataValue, StatusCodes, Variant, type StatusCode } from "node-opcua";

import type { Part } from "../model/part";
import { variant_at, type Construct } from "../model/values";
import type { PastValue, PastVariable } from "../serve/types";

export const NS_OF_MS = 1_000_000n;
export const PS_OF_NS = 1000;

// A value, or what is known instead of it from a time on.
export interface Entry {
  time_ns: bigint;
  bytes: Buffer | null;
  code: StatusCode;
}

export function value_entry(one: PastValue): Entry {
  return { time_ns: BigInt(one.time_ns), bytes: Buffer.from(one.bytes, "hex"), code: StatusCodes.Good };
}

// By time: values, and gaps where they begin.
export function entries_of(variable: PastVariable): Entry[] {
  const values = variable.values.map(value_entry);
  if (variable.gaps.length === 0) return values;
  const gaps = variable.gaps.map((gap): Entry => ({ time_ns: BigInt(gap.from_ns), bytes: null, code: StatusCodes.BadDataLost }));
  return [...gaps, ...values].sort((a, b) => (a.time_ns < b.time_ns ? -1 : a.time_ns > b.time_ns ? 1 : 0));
}

export function past_value(entry: Entry, { form }: Part, construct: Construct): DataValue {
  return new DataValue({
    value: entry.bytes ? variant_at(entry.bytes, 0, form, construct) : new Variant(),
    statusCode: entry.code,
    sourceTimestamp: new Date(Number(entry.time_ns / NS_OF_MS)),
    sourcePicoseconds: Number(entry.time_ns % NS_OF_MS) * PS_OF_NS,
  });
}
