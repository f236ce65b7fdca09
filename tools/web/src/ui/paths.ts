// SPDX-License-Identifier: Apache-2.0
// Parts of variables by name (joints[1].y is a part of joints): their types, and their values within the variable's value.

import type { Form, Range, Variable } from "../api/types";

export interface Part {
  name: string;
  label: string;
  form: Form;
  unit: string;
  range: Range | null;
  description: string;
  variable: Variable;
}

export function whole(variable: Variable): Part {
  const { name, form, unit, range, description } = variable;
  return { name, label: name.slice(name.lastIndexOf("::") + (name.includes("::") ? 2 : 0)), form, unit, range, description, variable };
}

export function has_parts({ form }: Part): boolean {
  return !!form.dims?.length || form.kind === "struct";
}

export function is_number({ form }: Part): boolean {
  return !form.dims?.length && !["struct", "text", "char"].includes(form.kind);
}

export function parts_of(part: Part): Part[] {
  const { form, name } = part;
  if (form.dims?.length) {
    const [count, ...inner] = form.dims;
    return Array.from({ length: count }, (_, i) => (
      { ...part, name: `${name}[${i}]`, label: `[${i}]`, form: { ...form, dims: inner }, description: "" }));
  }
  return (form.fields ?? []).map((field) => ({
    name: `${name}.${field.name}`, label: field.name, form: field.type, unit: field.unit || part.unit,
    range: field.range ?? null, description: field.description ?? "", variable: part.variable,
  }));
}

// The part of this name; null: there is none.
export function part_named(variables: Variable[], name: string): Part | null {
  const variable = variables.find((one) => name.startsWith(one.name) && /^($|[.[])/.test(name.slice(one.name.length)));
  let part: Part | null = variable ? whole(variable) : null;
  while (part && part.name !== name) {
    part = parts_of(part).find((one) => name.startsWith(one.name) && /^($|[.[])/.test(name.slice(one.name.length))) ?? null;
  }
  return part;
}

// All numbers of a variable, which can be plotted; at most `most`, for large arrays.
export function numbers_of(part: Part, most = 200): string[] {
  if (is_number(part)) return [part.name];
  if (!has_parts(part)) return [];
  const names: string[] = [];
  for (const inner of parts_of(part)) {
    if (names.length >= most) break;
    names.push(...numbers_of(inner, most - names.length));
  }
  return names;
}

// The value of the part `name` in the value of the whole variable.
export function value_in(value: unknown, variable: string, name: string): unknown {
  let at: any = value;
  for (const [, field, index] of name.slice(variable.length).matchAll(/\.(\w+)|\[(\d+)\]/g)) {
    if (at === null || at === undefined) return undefined;
    at = at[field ?? Number(index)];
  }
  return at;
}
