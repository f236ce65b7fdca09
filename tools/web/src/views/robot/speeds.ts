// SPDX-License-Identifier: Apache-2.0
// Colours of speeds, from slow to fast, and the end of their scale.

const SCALE = [[49, 84, 200], [32, 160, 190], [60, 175, 75], [235, 190, 40], [215, 55, 40]];

// `part`: of the greatest speed of the scale, from 0 to 1.
export function speed_rgb(part: number): string {
  const place = Math.min(1, Math.max(0, part || 0)) * (SCALE.length - 1);
  const i = Math.min(SCALE.length - 2, Math.floor(place));
  const mixed = SCALE[i].map((one, k) => Math.round(one + (place - i) * (SCALE[i + 1][k] - one)));
  return `rgb(${mixed.join(", ")})`;
}

// The next of 1, 2, 5, 10, 20, ... that is not less.
export function end_of_scale(fastest: number): number {
  const ten = 10 ** Math.floor(Math.log10(Math.max(1, fastest)));
  return [1, 2, 5, 10].map((one) => one * ten).find((end) => end >= fastest) ?? 10 * ten;
}

export const SCALE_STYLE = `linear-gradient(to right, ${SCALE.map((one) => `rgb(${one.join(", ")})`).join(", ")})`;
