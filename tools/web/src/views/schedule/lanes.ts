// SPDX-License-Identifier: Apache-2.0
// Runs of modules as bars: a lane per module, grouped by core; when each run was preempted, and whether it was late.

import type { Module, Overrun, Run } from "../../api/types";
import { span } from "../../ui/format";

export interface Bar {
  run: Run;
  late: boolean;
  preempted: [number, number][];  // by other modules on its core, ns
  before: Run | null;  // the run before it on its core, in the same tick
  overrun: Overrun | null;
}

export interface Lane {
  module: string;
  core: number;
  bars: Bar[];
}

export function lanes_of(runs: Run[], modules: Module[], overruns: Overrun[]): Lane[] {
  const known = new Map(modules.map((module) => [module.name, module]));
  const core_of = (name: string) => known.get(name)?.core ?? 0;
  const recorded = new Map(overruns.map((overrun) => [`${overrun.module} ${overrun.tick}`, overrun]));
  const by_core = new Map<number, Run[]>();
  for (const run of runs) by_core.set(core_of(run.module), [...(by_core.get(core_of(run.module)) ?? []), run]);
  for (const list of by_core.values()) list.sort((a, b) => a.start_ns - b.start_ns);
  const lanes = new Map<string, Lane>();
  for (const module of modules) {
    if (module.operation === "non-real" && !runs.some((run) => run.module === module.name)) continue;
    lanes.set(module.name, { module: module.name, core: core_of(module.name), bars: [] });
  }
  for (const [core, list] of by_core) {
    list.forEach((run, i) => {
      const preempted: [number, number][] = [];
      for (let j = i + 1; j < list.length && list[j].start_ns < run.end_ns; j++) {
        if (list[j].end_ns <= run.end_ns) preempted.push([list[j].start_ns, list[j].end_ns]);
      }
      const module = known.get(run.module);
      const allowed = module?.deadline_ns || module?.period_ns || 0;
      const overrun = recorded.get(`${run.module} ${run.tick}`) ?? null;
      const before = i > 0 && list[i - 1].tick === run.tick ? list[i - 1] : null;
      const late = overrun !== null || (allowed > 0 && run.end_ns - run.release_ns > allowed);
      const lane = lanes.get(run.module) ?? { module: run.module, core, bars: [] };
      lane.bars.push({ run, late, preempted, before, overrun });
      lanes.set(run.module, lane);
    });
  }
  const rank = (name: string) => known.get(name)?.priority ?? 0;
  return [...lanes.values()].sort((a, b) => a.core - b.core || rank(a.module) - rank(b.module) || a.module.localeCompare(b.module));
}

// The likely reason, from the recorded overrun, as in `indurop overruns`.
export function overrun_text({ module, tick, own_ns, latency_ns, previous, previous_ns, started }: Overrun, period_ns: number): string {
  if (!started) {
    // Only a module that took a large part of the period explains it.
    const explains = previous !== "" && 4 * previous_ns >= period_ns;
    return `${module} did not run in tick ${tick}: ${explains
      ? `${previous} took ${span(previous_ns)}.` : "no module took that long; the machine was busy or suspended."}`;
  }
  const late = latency_ns > own_ns;
  const why = !late ? "took too long" : previous !== "" && previous_ns > own_ns ? `started late, after ${previous}, which took ${span(previous_ns)}` : "started late";
  return `${module} ${why} in tick ${tick}: it started ${span(latency_ns)} after its release, and had used ${span(own_ns)} when it was released again.`;
}

// Why a run took place when it did, in sentences.
export function explain({ run, late, preempted, before, overrun }: Bar, module: Module | undefined, epoch_ns: number): string[] {
  const latency = run.start_ns - run.release_ns;
  const lines = [
    `Released in tick ${run.tick}, at ${((run.release_ns - epoch_ns) / 1e9).toFixed(6)} s after tick 0.`,
    `It started ${span(latency)} later and ended ${span(run.end_ns - run.release_ns)} after its release.`,
  ];
  if (before) lines.push(`Before it, ${before.module} ran on the same core for ${span(before.end_ns - before.start_ns)}.`);
  else if (latency > 0) lines.push("No other module ran before it in this tick: timer and operating system caused the delay.");
  const taken = preempted.reduce((sum, [from, to]) => sum + to - from, 0);
  lines.push(`It took ${span(run.end_ns - run.start_ns)}${taken ? `, including ${span(taken)} in which other modules ran` : ""}.`);
  if (module?.mean_exec_ns) lines.push(`Its mean time is ${span(module.mean_exec_ns)}, its maximum ${span(module.max_exec_ns)}.`);
  if (overrun) lines.push(overrun_text(overrun, module?.period_ns ?? 0));
  else if (late) lines.push("It missed its deadline.");
  return lines;
}
