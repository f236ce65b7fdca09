// SPDX-License-Identifier: Apache-2.0
// The lines of the tree: namespaces, variables, and the parts of expanded variables.

import type { Form, Variable } from "../../api/types";
import { has_parts, parts_of, whole, type Part } from "../../ui/paths";

export interface Row {
  key: string;
  level: number;
  label: string;
  opens: boolean;
  open: boolean;
  inside?: number;  // of a namespace: how many variables
  part?: Part;
}

const SEPARATOR = "::";

function fields_of(form: Form): string {
  return (form.fields ?? []).map(({ name, description, type }) => `${name} ${description ?? ""} ${fields_of(type)}`).join(" ");
}

function searched_text_of({ variable, form }: Part): string {
  return `${variable.name} ${fields_of(form)} ${variable.description} ${variable.unit}`.toLowerCase();
}

export function matching(variables: Variable[], search: string): Variable[] {
  const wanted = words_in(search);
  if (wanted.length === 0) return variables;
  return variables.filter((variable) => {
    const text = searched_text_of(whole(variable));
    return wanted.every((word) => text.includes(word));
  });
}

function words_in(search: string): string[] {
  return search.toLowerCase().split(/\s+/).filter(Boolean);
}

// A word of the search that matches a field but not the variable itself: the variable is expanded.
function matches_inside(part: Part, wanted: string[]): boolean {
  const whole_text = `${part.name} ${part.variable.description}`.toLowerCase();
  return parts_of({ ...part, form: { ...part.form, dims: [] } }).some((inner) => {
    const text = `${inner.label} ${inner.description}`.toLowerCase();
    return wanted.some((word) => !whole_text.includes(word) && text.includes(word)) || matches_inside(inner, wanted);
  });
}

interface Choice {
  open: Set<string>;
  closed: Set<string>;
  wanted: string[];
}

function add_part(rows: Row[], part: Part, level: number, choice: Choice): void {
  const opens = has_parts(part);
  const found = choice.wanted.length > 0 && opens && !part.form.dims?.length && !choice.closed.has(part.name) && matches_inside(part, choice.wanted);
  const is_open = opens && (choice.open.has(part.name) || found);
  rows.push({ key: part.name, level, label: part.label, opens, open: is_open, part });
  if (is_open) for (const inner of parts_of(part)) add_part(rows, inner, level + 1, choice);
}

// `closed` are lines that the user collapsed, `open` are variables that the user expanded. A search expands all namespaces,
// and structs with matching fields.
export function rows_of(variables: Variable[], search: string, open: Set<string>, closed: Set<string>): Row[] {
  const rows: Row[] = [];
  const sorted = [...matching(variables, search)].sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
  const add_namespace = (list: Variable[], space: string, level: number) => {
    const inner = new Map<string, Variable[]>();
    const own: Variable[] = [];
    for (const variable of list) {
      const rest = variable.name.slice(space.length);
      const end = rest.indexOf(SEPARATOR);
      if (end < 0) own.push(variable);
      else {
        const name = space + rest.slice(0, end + SEPARATOR.length);
        inner.set(name, [...(inner.get(name) ?? []), variable]);
      }
    }
    for (const [name, members] of inner) {
      const is_open = search !== "" || !closed.has(name);
      rows.push({ key: name, level, label: name.slice(space.length, -SEPARATOR.length), opens: true, open: is_open, inside: members.length });
      if (is_open) add_namespace(members, name, level + 1);
    }
    for (const variable of own) add_part(rows, whole(variable), level, { open, closed, wanted: words_in(search) });
  };
  add_namespace(sorted, "", 1);
  return rows;
}
