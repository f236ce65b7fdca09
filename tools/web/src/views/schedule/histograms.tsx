// SPDX-License-Identifier: Apache-2.0
// Four distributions of a module's times, on a logarithmic time axis.

import { board_path, get } from "../../api/http";
import type { Histogram } from "../../api/types";
import { count, span } from "../../ui/format";
import { useRequest } from "../../ui/store";

const EVERY_MS = 3000;
const WIDTH = 320;
const HEIGHT = 110;
const FOOT = 18;
const SHOWN: [string, string, string][] = [
  ["exec", "Execution", "time that a run took"],
  ["jitter", "Jitter", "deviation of the start from its ideal time"],
  ["latency", "Latency", "from its release to its start"],
  ["response", "Response", "from its release to its end"],
];

function Bars({ histogram }: { histogram: Histogram }) {
  const { bins } = histogram;
  const place = (ns: number) => Math.log10(Math.max(1, ns));
  const low = place(bins[0][0]);
  const high = Math.max(low + 0.1, place(bins[bins.length - 1][1]));
  const x = (ns: number) => (place(ns) - low) / (high - low) * WIDTH;
  const most = Math.max(...bins.map(([, , n]) => n));
  // Logarithmic, so that one late run among millions is visible.
  const tall = (n: number) => Math.log1p(n) / Math.log1p(most) * (HEIGHT - FOOT - 6);
  return (
    <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} class="bars" aria-hidden="true">
      {bins.map(([from, to, n]) => (
        <rect key={from} x={x(from)} width={Math.max(1, x(to) - x(from) - 0.6)} y={HEIGHT - FOOT - tall(n)} height={tall(n)}>
          <title>{`${span(from)} to ${span(to)}: ${count(n)}`}</title></rect>))}
      <line x1={0} x2={WIDTH} y1={HEIGHT - FOOT} y2={HEIGHT - FOOT} />
      <text x={0} y={HEIGHT - 4}>{span(bins[0][0])}</text>
      <text x={WIDTH} y={HEIGHT - 4} text-anchor="end">{span(bins[bins.length - 1][1])}</text>
    </svg>);
}

export function Histograms({ board, module }: { board: string; module: string }) {
  const { value, error } = useRequest(`${board} ${module}`, EVERY_MS,
    () => get<{ histograms: Record<string, Histogram> }>(board_path(board, `/modules/${encodeURIComponent(module)}/histograms`)));
  return (
    <section class="panel" aria-label={`Distributions of ${module}`}>
      <h2>{module}: distribution of its times</h2>
      {error && <p class="bad">{error}</p>}
      <div class="histograms">
        {value && SHOWN.filter(([name]) => value.histograms[name]).map(([name, title, hint]) => {
          const histogram = value.histograms[name];
          return (
            <figure key={name}>
              <figcaption><strong>{title}</strong> <span class="quiet">{hint}</span></figcaption>
              {histogram.bins.length > 0 ? <Bars histogram={histogram} /> : <p class="quiet">No measurements yet.</p>}
              <p class="small-print">half below {span(histogram.p50_ns)}, 99 % below {span(histogram.p99_ns)}, at most {span(histogram.max_ns)}; {count(histogram.count)} runs</p>
            </figure>);
        })}
      </div>
      <p class="quiet">The heights are logarithmic, so that one late run among many is visible.</p>
    </section>);
}
