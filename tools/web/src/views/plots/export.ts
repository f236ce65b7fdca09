// SPDX-License-Identifier: Apache-2.0
// Saves what the charts show as a file: numbers (CSV) or a picture (PNG).

import type uPlot from "uplot";
import { colour } from "../../shell/theme";
import type { Line, Shown } from "./chart";
import type { Samples } from "./recorder";

const LINE_PX = 20;

function download(name: string, blob: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

function file_name(ending: string): string {
  return `indurop-${new Date().toISOString().slice(0, 19).replaceAll(":", "")}.${ending}`;
}

function quoted(text: string): string {
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

export function csv_of(recorder: Samples & { board_times: Float64Array }, lines: Line[], { from, to }: Shown): string {
  const columns = ["utc", "board_time_s", ...lines.map(({ name, part }) => (part?.unit ? `${name} [${part.unit}]` : name))];
  const rows = [columns.map(quoted).join(",")];
  for (let i = recorder.index_at(from); i < recorder.size && recorder.times[i] <= to; i++) {
    if (Number.isNaN(recorder.board_times[i])) continue;  // a gap
    const values = lines.map(({ name }) => recorder.column(name)?.[i] ?? NaN);
    rows.push([new Date(recorder.times[i] * 1000).toISOString(), recorder.board_times[i],
      ...values.map((value) => (Number.isNaN(value) ? "" : value))].join(","));
  }
  return `${rows.join("\n")}\n`;
}

export function save_text(csv: string): void {
  download(file_name("csv"), new Blob([csv], { type: "text/csv" }));
}

export function save_csv(recorder: Samples & { board_times: Float64Array }, lines: Line[], shown: Shown): void {
  save_text(csv_of(recorder, lines, shown));
}

export function save_png(plots: uPlot[]): void {
  const ratio = devicePixelRatio;
  const canvas = document.createElement("canvas");
  const heights = plots.map(({ ctx, series }) => ctx.canvas.height + (series.length - 1) * LINE_PX * ratio);
  canvas.width = Math.max(...plots.map(({ ctx }) => ctx.canvas.width));
  canvas.height = heights.reduce((sum, height) => sum + height, 0);
  const to = canvas.getContext("2d")!;
  to.fillStyle = colour("panel");
  to.fillRect(0, 0, canvas.width, canvas.height);
  to.font = `${13 * ratio}px sans-serif`;
  to.textBaseline = "middle";
  let y = 0;
  for (const { ctx, series } of plots) {
    series.slice(1).forEach(({ label }, i) => {
      const middle = y + LINE_PX * ratio / 2;
      to.fillStyle = colour(`c${i % 8}`);
      to.fillRect(8 * ratio, middle - 2 * ratio, 18 * ratio, 4 * ratio);
      to.fillStyle = colour("text");
      to.fillText(String(label), 32 * ratio, middle);
      y += LINE_PX * ratio;
    });
    to.drawImage(ctx.canvas, 0, y);
    y += ctx.canvas.height;
  }
  canvas.toBlob((blob) => blob && download(file_name("png"), blob), "image/png");
}
