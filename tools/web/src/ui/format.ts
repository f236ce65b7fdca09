// SPDX-License-Identifier: Apache-2.0
// Numbers and times as text, with units.

const UNITS: [number, string][] = [[1e9, "s"], [1e6, "ms"], [1e3, "us"]];

export function span(ns: number | null | undefined): string {
  if (ns === null || ns === undefined) return "-";
  if (Math.abs(ns) >= 120e9) return long_span(ns / 1e9);
  for (const [size, unit] of UNITS) if (Math.abs(ns) >= size) return `${short(ns / size)} ${unit}`;
  return `${Math.round(ns)} ns`;
}

function long_span(seconds: number): string {
  const minutes = seconds / 60;
  if (minutes < 120) return `${Math.floor(minutes)} min ${Math.floor(seconds % 60)} s`;
  const hours = minutes / 60;
  if (hours < 48) return `${Math.floor(hours)} h ${Math.floor(minutes % 60)} min`;
  return `${Math.floor(hours / 24)} d ${Math.floor(hours % 24)} h`;
}

// Three significant digits, and an exponent only for very small and very large values.
export function short(value: number): string {
  if (!Number.isFinite(value)) return "not a number";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e9)) return value.toExponential(2);
  return value.toFixed(size >= 100 || Number.isInteger(value) ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
}

export function count(value: number): string {
  return Math.round(value).toString().replace(/\B(?=(\d{3})+$)/g, " ");
}

export function plural(n: number, one: string, many = `${one}s`): string {
  return `${count(n)} ${n === 1 ? one : many}`;
}

export function percent(share: number): string {
  return share > 0 && share < 0.01 ? "< 1 %" : `${Math.round(share * 100)} %`;
}

export function clock(wall_ns: number): string {
  const at = new Date(wall_ns / 1e6);
  return `${at.toISOString().slice(0, 10)} ${at.toTimeString().slice(0, 8)}`;
}

// A value as text: enumerators by name, numbers with six significant digits.
export function value_text(value: unknown, enumerators?: Record<string, number>): string {
  if (value === undefined) return "...";
  if (value === null) return "not a number";
  if (typeof value === "number") {
    const name = enumerators && Object.entries(enumerators).find(([, number]) => number === value)?.[0];
    if (name) return name;
    return Number.isInteger(value) ? String(value) : Number(value.toPrecision(6)).toString();
  }
  if (typeof value === "string") return value === "" ? "(empty)" : value;
  if (Array.isArray(value)) return value.map((item) => value_text(item, enumerators)).join(", ");
  if (typeof value === "object") return Object.entries(value as object).map(([name, item]) => `${name} ${value_text(item)}`).join(", ");
  return String(value);
}
