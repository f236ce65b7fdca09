// SPDX-License-Identifier: Apache-2.0
// Small pieces that several views are made of.

import type { ComponentChildren } from "preact";

interface PanelProps {
  title: string;
  state?: string;
  good?: boolean;
  children: ComponentChildren;
}

export function Panel({ title, state, good, children }: PanelProps) {
  return (
    <section class="panel" aria-label={title}>
      <h2>{title}{state && <span class={`chip ${good ? "good" : "bad"}`}>{state}</span>}</h2>
      {children}
    </section>);
}

interface FigureProps {
  name: string;
  value: string;
  hint?: string;
  bad?: boolean;
  warn?: boolean;
}

export function Figure({ name, value, hint, bad, warn }: FigureProps) {
  return <div title={hint}><dt>{name}</dt><dd class={bad ? "bad" : warn ? "warn" : ""}>{value}</dd></div>;
}

export function Waiting() {
  return <p class="waiting" aria-live="polite">Asking the server ...</p>;
}
