// SPDX-License-Identifier: Apache-2.0
// Small pieces that several views are made of.

import type { ComponentChildren } from "preact";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";

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

// A table of figures. On a phone each of its lines is a block, in which every cell is called as its column is.
export function Figures({ label, more = "", children }: { label: string; more?: string; children: ComponentChildren }) {
  const table = useRef<HTMLTableElement>(null);
  useLayoutEffect(() => {
    const heads = [...table.current!.querySelectorAll("thead th")].map((head) => head.textContent ?? "");
    for (const row of table.current!.tBodies[0]?.rows ?? []) {
      for (const cell of row.cells) cell.dataset.name = heads[cell.cellIndex] ?? "";
    }
  });
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={label}>
      <table ref={table} class={`figures ${more}`}>{children}</table>
    </div>);
}

interface ConfirmProps {
  title: string;
  yes: string;
  no: string;
  agree: () => void;
  close: () => void;
  children: ComponentChildren;
}

// Asked before what cannot be undone. Escape is the same as `no`.
export function Confirm({ title, yes, no, agree, close, children }: ConfirmProps) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.showModal(), []);
  return (
    <dialog ref={dialog} class="panel" aria-label={title} onClose={close}>
      <h2>{title}</h2>
      {children}
      <div class="bar">
        <button type="button" autofocus onClick={close}>{no}</button>
        <button type="button" class="danger" onClick={agree}>{yes}</button>
      </div>
    </dialog>);
}
