// SPDX-License-Identifier: Apache-2.0
// The tree as lines: namespaces, variables, and the parts of those that are opened.

import type { Variable } from "../../api/types";
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

function said_of(part: Part): string {
  const { variable, form } = part;
  const fields = (form.fields ?? []).map(({ name }) => `${variable.name}.${name}`).join(" ");
  return `${variable.name} ${fields} ${variable.description} ${variable.unit}`.toLowerCase();
}

export function matching(variables: Variable[], search: string): Variable[] {
  const wanted = search.toLowerCase().split(/\s+/).filter(Boolean);
  if (wanted.length === 0) return variables;
  return variables.filter((variable) => {
    const said = said_of(whole(variable));
    return wanted.every((word) => said.includes(word));
  });
}

function add_part(rows: Row[], part: Part, level: number, open: Set<string>): void {
  const opens = has_parts(part);
  const is_open = opens && open.has(part.name);
  rows.push({ key: part.name, level, label: part.label, opens, open: is_open, part });
  if (is_open) for (const inner of parts_of(part)) add_part(rows, inner, level + 1, open);
}

// `shut` are namespaces that somebody closed, `open` variables that somebody opened; a search opens all namespaces.
export function rows_of(variables: Variable[], search: string, open: Set<string>, shut: Set<string>): Row[] {
  const rows: Row[] = [];
  const sorted = [...matching(variables, search)].sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
  const walk = (list: Variable[], space: string, level: number) => {
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
      const is_open = search !== "" || !shut.has(name);
      rows.push({ key: name, level, label: name.slice(space.length, -SEPARATOR.length), opens: true, open: is_open, inside: members.length });
      if (is_open) walk(members, name, level + 1);
    }
    for (const variable of own) add_part(rows, whole(variable), level, open);
  };
  walk(sorted, "", 1);
  return rows;
}
