// SPDX-License-Identifier: Apache-2.0
// Components that several views share.

import { type ComponentChildren, Fragment } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";

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

interface FactProps {
  name: string;
  value: string;
  hint?: string;
  bad?: boolean;
  warn?: boolean;
}

export function Fact({ name, value, hint, bad, warn }: FactProps) {
  return <div title={hint}><dt>{name}</dt><dd class={bad ? "bad" : warn ? "warn" : ""}>{value}</dd></div>;
}

// A name that a narrow cell breaks after "::" and ".", not within a word.
export function Name({ text }: { text: string }) {
  return <>{text.split(/(?<=::|\.|_)/).map((part, i) => <Fragment key={i}>{part}<wbr /></Fragment>)}</>;
}

export function Waiting() {
  return <p class="waiting" aria-live="polite">Loading ...</p>;
}

// A table of values. On a phone each row is a block, and each cell shows the name of its column.
export function DataTable({ label, more = "", children }: { label: string; more?: string; children: ComponentChildren }) {
  const table = useRef<HTMLTableElement>(null);
  useLayoutEffect(() => {
    const heads = [...table.current!.querySelectorAll("thead th")].map((head) => head.textContent ?? "");
    for (const row of table.current!.tBodies[0]?.rows ?? []) {
      for (const cell of row.cells) cell.dataset.name = heads[cell.cellIndex] ?? "";
    }
  });
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={label}>
      <table ref={table} class={`data-table ${more}`}>{children}</table>
    </div>);
}

// Properties of an <input> that calls `enter` with Enter and when it is left. What is typed stays in it until then: the view is
// rendered again with each new sample, and `value` would replace it.
export function useEntry(value: string | number, enter: (text: string) => void) {
  const [typed, set_typed] = useState<string | null>(null);
  return {
    value: typed ?? value,
    onInput: (event: Event) => set_typed((event.currentTarget as HTMLInputElement).value),
    onBlur: () => set_typed(null),
    onChange: (event: Event) => { set_typed(null); enter((event.currentTarget as HTMLInputElement).value); },
  };
}

interface ConfirmProps {
  title: string;
  yes: string;
  no: string;
  agree: () => void;
  close: () => void;
  children: ComponentChildren;
}

// A question before an action that cannot be undone. Escape has the effect of `no`.
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
