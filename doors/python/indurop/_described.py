# SPDX-License-Identifier: Apache-2.0
"""What is declared of a variable: of a node, of a recording or of a board elsewhere."""

from __future__ import annotations

from typing import Any

from indurop import _layout
from indurop._library import text


class Described:
    """A variable or a part of one, and what is declared of it."""

    name: str  # full name, with the part
    type: str  # as declared: "knu::Robot::joints_t[10]"
    unit: str
    description: str
    source: str  # place of the declaration, "knuRobot.glb:3"
    size: int  # bytes
    range: tuple[float, float] | None
    retain: bool
    parameter: bool  # declared with an initial value
    layout: _layout.Layout

    def _take(self, about: Any) -> None:
        """Takes what the C library says, an irp_variable."""
        self.name = text(about.name)
        self.type = text(about.type)
        self.unit = text(about.unit)
        self.description = text(about.description)
        self.source = text(about.source)
        self.size = int(about.size)
        self.range = (float(about.min), float(about.max)) if about.flags & 1 else None
        self.retain = bool(about.flags & 2)
        self.parameter = bool(about.flags & 4)
        self.layout = _layout.parse(text(about.layout))

    def __repr__(self) -> str:
        return f"<{self.name}: {self.type}>"
