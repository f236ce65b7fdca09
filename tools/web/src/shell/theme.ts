// SPDX-License-Identifier: Apache-2.0
// Light or dark: the system's setting, until the user selects one. Kept in the browser.

import { Store } from "../ui/store";

const KEY = "indurop.theme";
export const THEMES = ["auto", "light", "dark"] as const;
export type Theme = (typeof THEMES)[number];

const system = matchMedia("(prefers-color-scheme: dark)");
const stored = localStorage.getItem(KEY) as Theme | null;
export const theme = new Store<Theme>(stored && THEMES.includes(stored) ? stored : "auto");
// Counts changes, for drawings that take their colours from the style sheet.
export const colours_changed = new Store(0);

function apply(): void {
  const dark = theme.get() === "dark" || (theme.get() === "auto" && system.matches);
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  colours_changed.set(colours_changed.get() + 1);
}

export function set_theme(next: Theme): void {
  localStorage.setItem(KEY, next);
  theme.set(next);
  apply();
}

export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

// Size of letters in pixels, for drawings: it grows with the screen.
export function letter_px(): number {
  return parseFloat(getComputedStyle(document.documentElement).fontSize);
}

system.addEventListener("change", apply);
apply();
