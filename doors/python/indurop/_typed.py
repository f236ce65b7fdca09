# SPDX-License-Identifier: Apache-2.0
"""Variables of modules that `glb2idl --python` writes: types for type checkers, nothing at run time."""

from __future__ import annotations

from typing import Any, AsyncIterator, Iterator, Protocol, TypeVar

from indurop._node import Quality

T = TypeVar("T", covariant=True)


class TypedVariable(Protocol[T]):
    """What a variable of a node of this machine and one of a board elsewhere have in common."""

    name: str
    type: str
    unit: str
    description: str
    range: tuple[float, float] | None

    @property
    def value(self) -> T: ...

    @property
    def quality(self) -> Quality: ...

    def write(self, value: Any, reason: str = "") -> None: ...

    def force(self, value: Any, seconds: float = 0, reason: str = "") -> None: ...

    def release(self, reason: str = "") -> None: ...

    def watch(self, timeout: float | None = None) -> Iterator[T]: ...

    def watch_async(self) -> AsyncIterator[T]: ...
