// SPDX-License-Identifier: Apache-2.0
// The charts in the address: c=a,b&c=d are two charts, w is the window in seconds, hz the rate.

import { change_query } from "../../ui/address";

export interface Layout {
  charts: string[][];
  window_s: number;
  rate_hz: number;
}

export type Mode = "strip" | "single" | "normal" | "auto" | "recording";
export const MODES: Mode[] = ["strip", "single", "normal", "auto", "recording"];

// In the address m is the mode, t the trigger, pre and post are the ticks before and after it, e is an expression with its own chart.
export interface Scope {
  mode: Mode;
  trigger: string;
  pre: number;
  post: number;
  expressions: string[];
}

export function scope_of(query: URLSearchParams): Scope {
  const ticks = (name: string, otherwise: number) => {
    const given = Number(query.get(name) ?? otherwise);
    return Number.isInteger(given) && given >= 0 && given < 10_000 ? given : otherwise;
  };
  const mode = MODES.find((one) => one === query.get("m")) ?? "strip";
  return { mode, trigger: query.get("t") ?? "", pre: ticks("pre", 100), post: ticks("post", 400), expressions: [...new Set(query.getAll("e"))] };
}

export const WINDOWS_S = [5, 10, 30, 60, 300, 1200];
export const RATES_HZ = [1, 5, 10, 25, 50, 100];

function one_of(value: string | null, of: number[], otherwise: number): number {
  return of.includes(Number(value)) ? Number(value) : otherwise;
}

export function layout_of(query: URLSearchParams): Layout {
  return {
    charts: query.getAll("c").map((names) => [...new Set(names.split(",").filter(Boolean))]),
    window_s: one_of(query.get("w"), WINDOWS_S, 30),
    rate_hz: one_of(query.get("hz"), RATES_HZ, 25),
  };
}

export function show_charts(charts: string[][]): void {
  // The address cannot hold a chart without names.
  change_query({ c: charts.filter((names) => names.length > 0).map((names) => names.join(",")) });
}
