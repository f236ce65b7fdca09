// SPDX-License-Identifier: Apache-2.0
// Decodes bytes of a board's memory to values, by their form (docs/serve.md, "Binary frames").

import type { Form, Quality, Subscribed } from "./types";

const QUALITIES: Quality[] = ["good", "stale", "silent", "unread"];
const HEADER = 40;
const text_decoder = new TextDecoder();

export interface Frame {
  stream: number;
  seq: number;
  time_ns: number;
  wall_ns: number;
  alive: boolean;
  view: DataView;
}

function scalar(view: DataView, at: number, form: Form): unknown {
  switch (form.kind) {
    case "bool": return view.getUint8(at) !== 0;
    case "char":
    case "u8": return view.getUint8(at);
    case "i8": return view.getInt8(at);
    case "i16": return view.getInt16(at, true);
    case "u16": return view.getUint16(at, true);
    case "enum":
    case "i32": return view.getInt32(at, true);
    case "u32": return view.getUint32(at, true);
    // Exact up to 2^53; the page shows larger values rounded.
    case "i64": return Number(view.getBigInt64(at, true));
    case "u64": return Number(view.getBigUint64(at, true));
    case "f32": return view.getFloat32(at, true);
    case "f64": return view.getFloat64(at, true);
    case "text": {
      const bytes = new Uint8Array(view.buffer, view.byteOffset + at, form.size);
      const end = bytes.indexOf(0);
      return text_decoder.decode(end < 0 ? bytes : bytes.subarray(0, end));
    }
    case "struct":
      return Object.fromEntries((form.fields ?? []).map((field) => [field.name, decode(view, at + field.offset, field.type)]));
    default: return null;
  }
}

export function decode(view: DataView, at: number, form: Form): unknown {
  if (!form.dims?.length) return scalar(view, at, form);
  const [count, ...inner] = form.dims;
  const element: Form = { ...form, dims: inner };
  const step = inner.reduce((product, dim) => product * dim, form.size);
  return Array.from({ length: count }, (_, i) => decode(view, at + i * step, element));
}

// null: not a frame of values, or of an unknown version.
export function frame_of(data: ArrayBuffer): Frame | null {
  if (data.byteLength < HEADER) return null;
  const view = new DataView(data);
  if (view.getUint8(0) !== 1 || view.getUint8(1) !== 1) return null;
  return {
    stream: view.getUint32(4, true),
    seq: Number(view.getBigUint64(8, true)),
    time_ns: Number(view.getBigInt64(16, true)),
    wall_ns: Number(view.getBigInt64(24, true)),
    alive: (view.getUint16(2, true) & 1) !== 0,
    view,
  };
}

export function quality_of(frame: Frame, of: Subscribed, index: number): { quality: Quality; forced: boolean } {
  const byte = frame.view.getUint8(of.quality_offset + index);
  return { quality: QUALITIES[byte & 3], forced: (byte & 4) !== 0 };
}
