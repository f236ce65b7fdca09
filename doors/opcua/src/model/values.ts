// SPDX-License-Identifier: Apache-2.0
// Values: from the bytes of a board's memory to OPC UA, and from OPC UA to the text that `indurop set` reads.

import { DataType, Variant, VariantArrayType, type ExtensionObject } from "node-opcua";

import type { Field, Form } from "../serve/types";
import { elements_of } from "./part";

const BUILT_IN = {
  bool: DataType.Boolean, char: DataType.Byte, i8: DataType.SByte, u8: DataType.Byte, i16: DataType.Int16, u16: DataType.UInt16,
  i32: DataType.Int32, u32: DataType.UInt32, i64: DataType.Int64, u64: DataType.UInt64, f32: DataType.Float, f64: DataType.Double,
  text: DataType.String, wide_text: DataType.String, enum: DataType.Int32, struct: DataType.ExtensionObject, instance: DataType.Null, reference: DataType.Null,
} as const;

// Makes the object of a structure from its fields.
export type Construct = (form: Form, fields: Record<string, unknown>) => ExtensionObject;

export function built_in(form: Form): DataType {
  return BUILT_IN[form.kind];
}

// The name that node-opcua gives a field in its objects.
export function key_of(field: Field): string {
  return field.name.charAt(0).toLowerCase() + field.name.slice(1);
}

function text_at(bytes: Buffer, at: number, size: number): string {
  const end = bytes.indexOf(0, at);
  return bytes.toString("utf8", at, end < 0 || end > at + size ? at + size : end);
}

function wide_text_at(bytes: Buffer, at: number, size: number): string {
  const text = bytes.toString("utf16le", at, at + size);
  const end = text.indexOf("\0");
  return end < 0 ? text : text.slice(0, end);
}

// Those of local variables of PLC programs have other sizes, too.
function enum_at(bytes: Buffer, at: number, { size, unsigned }: Form): number {
  const length = Math.min(size, 4);
  return unsigned && length < 4 ? bytes.readUIntLE(at, length) : bytes.readIntLE(at, length);
}

function element(bytes: Buffer, at: number, form: Form, construct: Construct): unknown {
  switch (form.kind) {
    case "bool": return bytes[at] !== 0;
    case "char":
    case "u8": return bytes[at];
    case "i8": return bytes.readInt8(at);
    case "i16": return bytes.readInt16LE(at);
    case "u16": return bytes.readUInt16LE(at);
    case "enum": return enum_at(bytes, at, form);
    case "i32": return bytes.readInt32LE(at);
    case "u32": return bytes.readUInt32LE(at);
    case "i64":
    case "u64": return [bytes.readUInt32LE(at + 4), bytes.readUInt32LE(at)];  // high, low
    case "f32": return bytes.readFloatLE(at);
    case "f64": return bytes.readDoubleLE(at);
    case "text": return text_at(bytes, at, form.size);
    case "wide_text": return wide_text_at(bytes, at, form.size);
    case "instance":
    case "reference": return null;
    case "struct":
      return construct(form, Object.fromEntries((form.fields ?? []).map(
        (field) => [key_of(field), plain(bytes, at + field.offset, field.type, construct)])));
  }
}

// A value, or its elements in one array, the last index fastest.
function plain(bytes: Buffer, at: number, form: Form, construct: Construct): unknown {
  if (!form.dims?.length) return element(bytes, at, form, construct);
  return Array.from({ length: elements_of(form) }, (_, i) => element(bytes, at + i * form.size, form, construct));
}

export function variant_at(bytes: Buffer, at: number, form: Form, construct: Construct): Variant {
  const dims = form.dims ?? [];
  const arrayType = dims.length > 1 ? VariantArrayType.Matrix : dims.length ? VariantArrayType.Array : VariantArrayType.Scalar;
  return new Variant({
    dataType: built_in(form),
    arrayType,
    dimensions: dims.length > 1 ? dims : null,
    value: plain(bytes, at, form, construct),
  });
}

export class WrongType extends Error {}

function quoted(text: string): string {
  return `"${text.replace(/["\\]/g, "\\$&").replace(/[\x00-\x1f\x7f]/g, (c) => `\\x${c.charCodeAt(0).toString(16).padStart(2, "0")}`)}"`;
}

function number_text(value: unknown): string {
  if (typeof value !== "number") throw new WrongType("a number is wanted");
  if (Number.isNaN(value)) return "nan";
  if (!Number.isFinite(value)) return value > 0 ? "inf" : "-inf";
  return Object.is(value, -0) ? "-0" : `${value}`;
}

// Node-opcua has 64-bit integers as [high, low].
export function wide_of([high, low]: number[], signed: boolean): bigint {
  const wide = (BigInt(high >>> 0) << 32n) | BigInt(low >>> 0);
  return signed ? BigInt.asIntN(64, wide) : wide;
}

function wide_text(value: unknown, signed: boolean): string {
  return Array.isArray(value) && value.length === 2 ? `${wide_of(value, signed)}` : number_text(value);
}

function element_text(value: unknown, form: Form): string {
  switch (form.kind) {
    case "bool": return value ? "true" : "false";
    case "char": {
      if (typeof value !== "number") throw new WrongType("a byte is wanted");
      return `'\\x${value.toString(16).padStart(2, "0")}'`;
    }
    case "text": return quoted(typeof value === "string" ? value : "");
    case "i64": return wide_text(value, true);
    case "u64": return wide_text(value, false);
    case "struct": {
      if (typeof value !== "object" || value === null) throw new WrongType("a structure is wanted");
      const fields = value as Record<string, unknown>;
      return `{${(form.fields ?? []).map((field) => `${field.name}: ${text_of(fields[key_of(field)], field.type)}`).join(", ")}}`;
    }
    default: return number_text(value);
  }
}

function nested(values: ArrayLike<unknown>, form: Form, dims: number[], from: number): string {
  const [count, ...inner] = dims;
  const step = inner.reduce((product, dim) => product * dim, 1);
  const texts = Array.from({ length: count }, (_, i) => inner.length
    ? nested(values, form, inner, from + i * step)
    : element_text(values[from + i], form));
  return `[${texts.join(", ")}]`;
}

// The text of a value; of an array its elements in one list, the last index fastest. Throws WrongType.
export function text_of(value: unknown, form: Form): string {
  if (!form.dims?.length) return element_text(value, form);
  const values = value as ArrayLike<unknown> | null;
  if (!values || typeof values !== "object" || values.length !== elements_of(form)) {
    throw new WrongType(`${elements_of(form)} elements are wanted`);
  }
  return nested(values, form, form.dims, 0);
}
