// SPDX-License-Identifier: Apache-2.0
// A variable and its parts by name: `joints`, `joints[1]`, `joints[1].y`. Parts are what has a node of its own; elements of
// arrays of numbers have none, because clients read them by index range.

import type { Field, Form, Range, VariableDescription } from "../serve/types";

const MOST_PARTS = 2000;  // of one variable; with more it is shown as a whole only

export interface Part {
  path: string;  // full name
  label: string;  // last part of the name
  form: Form;
  offset: number;  // bytes from the begin of the variable
  unit: string;
  range: Range | null;
  description: string;
  children: Part[];
}

export function elements_of(form: Form): number {
  return (form.dims ?? []).reduce((product, dim) => product * dim, 1);
}

export function bytes_of(form: Form): number {
  return elements_of(form) * form.size;
}

function indices(dims: number[], at: number): string {
  let text = "";
  for (let dim = dims.length - 1; dim >= 0; dim--) {
    text = `[${at % dims[dim]}]${text}`;
    at = Math.floor(at / dims[dim]);
  }
  return text;
}

// "[1][2]", or as IEC 61131-3 writes it, with its bounds: "[1,2]".
export function index_text({ dims, low }: Form, at: number): string {
  if (!low) return indices(dims!, at);
  const texts: string[] = [];
  for (let dim = dims!.length - 1; dim >= 0; dim--) {
    texts.unshift(`${(at % dims![dim]) + low[dim]}`);
    at = Math.floor(at / dims![dim]);
  }
  return `[${texts.join(",")}]`;
}

function count_parts(form: Form): number {
  if (form.kind !== "struct") return 1;
  const inner = (form.fields ?? []).reduce((sum, field) => sum + count_parts(field.type), 1);
  return form.dims?.length ? 1 + elements_of(form) * inner : inner;
}

function field_part(field: Field, parent: Part): Part {
  const part: Part = {
    path: `${parent.path}.${field.name}`,
    label: field.name,
    form: field.type,
    offset: parent.offset + field.offset,
    unit: field.unit ?? "",
    range: field.range ?? null,
    description: field.description ?? "",
    children: [],
  };
  part.children = children_of(part);
  return part;
}

function element_part(parent: Part, index: number): Part {
  const label = index_text(parent.form, index);
  const { dims: _, low: __, ...form } = parent.form;
  const part: Part = {
    ...parent,
    path: parent.path + label,
    label,
    form,
    offset: parent.offset + index * parent.form.size,
    description: "",
  };
  part.children = children_of(part);
  return part;
}

export function children_of(part: Part): Part[] {
  if (part.form.kind !== "struct") return [];
  if (!part.form.dims?.length) return (part.form.fields ?? []).map((field) => field_part(field, part));
  return Array.from({ length: elements_of(part.form) }, (_, index) => element_part(part, index));
}

export function part_of(variable: VariableDescription): Part {
  const part: Part = {
    path: variable.name,
    label: variable.name.slice(variable.name.lastIndexOf(":") + 1),
    form: variable.form,
    offset: 0,
    unit: variable.unit,
    range: variable.range,
    description: variable.description,
    children: [],
  };
  if (!has_too_many_parts(variable.form)) part.children = children_of(part);
  return part;
}

export function has_too_many_parts(form: Form): boolean {
  return count_parts(form) > MOST_PARTS;
}

export function* parts_below(part: Part): Generator<Part> {
  yield part;
  for (const child of part.children) yield* parts_below(child);
}
