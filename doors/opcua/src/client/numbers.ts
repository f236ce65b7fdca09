// SPDX-License-Identifier: Apache-2.0
// Numbers of points as values of OPC UA, and back.

import { DataType, StatusCodes, Variant, VariantArrayType, type DataValue, type StatusCode } from "node-opcua";

import { wide_of } from "../model/values";
import { Quality } from "./protocol";

const INTEGERS = new Map<DataType, [bigint, bigint]>([
  [DataType.SByte, [-(2n ** 7n), 2n ** 7n - 1n]], [DataType.Byte, [0n, 2n ** 8n - 1n]],
  [DataType.Int16, [-(2n ** 15n), 2n ** 15n - 1n]], [DataType.UInt16, [0n, 2n ** 16n - 1n]],
  [DataType.Int32, [-(2n ** 31n), 2n ** 31n - 1n]], [DataType.UInt32, [0n, 2n ** 32n - 1n]],
  [DataType.Int64, [-(2n ** 63n), 2n ** 63n - 1n]], [DataType.UInt64, [0n, 2n ** 64n - 1n]],
]);
const LARGEST_FLOAT = (2 - 2 ** -23) * 2 ** 127;
// The server has no such point, or not for this user or this kind of access; it will not have it in the next cycle, either.
const REFUSALS = new Set([
  StatusCodes.BadNodeIdUnknown, StatusCodes.BadNodeIdInvalid, StatusCodes.BadAttributeIdInvalid, StatusCodes.BadNotReadable, StatusCodes.BadNotWritable,
  StatusCodes.BadUserAccessDenied, StatusCodes.BadTypeMismatch, StatusCodes.BadWriteNotSupported, StatusCodes.BadNotSupported,
].map((code) => code.value));

export function quality_of(status: StatusCode): Quality {
  if (status.isGood()) return Quality.Good;
  if (REFUSALS.has(status.value)) return Quality.Refused;
  return status.equals(StatusCodes.BadOutOfRange) ? Quality.OutOfRange : Quality.Reported;
}

// The text of a JSON number, null for NaN and infinities; nothing if it is no number.
export function number_in(variant: Variant | undefined): string | undefined {
  if (!variant || variant.arrayType !== VariantArrayType.Scalar) return undefined;
  const { dataType, value } = variant;
  if (dataType === DataType.Boolean) return value ? "1" : "0";
  if (dataType === DataType.Int64 || dataType === DataType.UInt64) return `${wide_of(value, dataType === DataType.Int64)}`;
  if (dataType !== DataType.Float && dataType !== DataType.Double && !INTEGERS.has(dataType)) return undefined;
  return JSON.stringify(value as number);
}

export function read_number({ statusCode, value }: DataValue): [Quality, string] {
  const quality = quality_of(statusCode);
  const number = quality === Quality.Good ? number_in(value) : "0";
  return number === undefined ? [Quality.Refused, "0"] : [quality, number];
}

// The value that a node of this type gets; the nearest one, if it cannot hold the number. Nothing: it holds no number.
export function variant_of(text: string, dataType: DataType): { variant: Variant; fits: boolean } | undefined {
  const scalar = (value: unknown, fits: boolean): { variant: Variant; fits: boolean } => ({ variant: new Variant({ dataType, arrayType: VariantArrayType.Scalar, value }), fits });
  const number = Number(text);
  const limits = INTEGERS.get(dataType);
  if (limits) {
    const whole = /^-?[0-9]+$/u.test(text) ? BigInt(text) : BigInt(Math.round(number));
    const nearest = whole < limits[0] ? limits[0] : whole > limits[1] ? limits[1] : whole;
    const is_long = dataType === DataType.Int64 || dataType === DataType.UInt64;
    const bits = BigInt.asUintN(64, nearest);
    return scalar(is_long ? [Number(bits >> 32n), Number(bits & 0xFFFF_FFFFn)] : Number(nearest), nearest === whole);
  }
  if (dataType === DataType.Boolean) return scalar(number !== 0, true);
  if (dataType === DataType.Double) return scalar(number, true);
  if (dataType !== DataType.Float) return undefined;
  return scalar(Math.max(-LARGEST_FLOAT, Math.min(LARGEST_FLOAT, number)), Math.abs(number) <= LARGEST_FLOAT);
}
