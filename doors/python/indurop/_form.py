# SPDX-License-Identifier: Apache-2.0
"""Types and values as `indurop serve` sends and takes them: the schema Type of its OpenAPI description, JSON values, and
texts as of `indurop set`."""

from __future__ import annotations

import enum
import json
from typing import Any, Mapping, cast

from indurop._layout import Field, Layout, Record


def layout_of(form: Mapping[str, Any]) -> Layout:
    layout = Layout(form["kind"], int(form["size"]), list(form.get("dims", [])))
    for one in form.get("fields", []):
        layout.fields.append(Field(one["name"], int(one["offset"]), layout_of(one["type"])))
    if layout.base == "enum":
        layout.names = cast("type[enum.IntEnum]", enum.IntEnum("Enumeration", dict(form["enumerators"])))
    return layout


def value_of(layout: Layout, value: Any, dim: int = 0) -> Any:
    """A JSON value as Python sees it elsewhere. NaN and infinities are null in JSON, and become NaN."""
    if dim < len(layout.dims):
        return [value_of(layout, one, dim + 1) for one in value]
    if layout.base == "struct":
        return Record(**{f.name: value_of(f.layout, value[f.name]) for f in layout.fields})
    if layout.base == "enum" and layout.names is not None:
        return layout.names[value] if isinstance(value, str) else value
    if layout.base in ("f32", "f64"):
        return float("nan") if value is None else float(value)
    return value


def text_of(layout: Layout, value: Any, dim: int = 0) -> str:
    """A value that the layout can hold, as `indurop set` takes it. Fields that a dict leaves out are left out."""
    if dim < len(layout.dims):
        return "[" + ", ".join(text_of(layout, one, dim + 1) for one in value) + "]"
    if layout.base == "struct":
        fields = value.__dict__ if isinstance(value, Record) else value
        layouts = {f.name: f.layout for f in layout.fields}
        return "{" + ", ".join(f"{name}: {text_of(layouts[name], one)}" for name, one in fields.items()) + "}"
    if layout.base in ("text", "char"):
        return json.dumps(value.decode("latin-1") if isinstance(value, bytes) else str(value), ensure_ascii=False)
    if layout.base == "enum":
        return value if isinstance(value, str) else str(int(value))
    if layout.base == "bool":
        return "true" if value else "false"
    return repr(float(value)) if layout.base in ("f32", "f64") else str(int(value))
