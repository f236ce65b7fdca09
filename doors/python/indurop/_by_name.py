# SPDX-License-Identifier: Apache-2.0
"""What a node, a recording and a board elsewhere have in common: variables by name, and an end."""

from __future__ import annotations

from typing import Any, Generic, TypeVar

from indurop._errors import NotFound

V = TypeVar("V")
S = TypeVar("S", bound="ByName[Any]")


class ByName(Generic[V]):
    """Remembers the variables that were asked for. Has a context that closes it."""

    _known: dict[str, V]

    def _find(self, name: str) -> V:
        raise NotImplementedError

    def close(self) -> None:
        raise NotImplementedError

    def variable(self, name: str) -> V:
        known = self._known.get(name)
        if known is None:
            known = self._known[name] = self._find(name)
        return known

    def __contains__(self, name: str) -> bool:
        try:
            self.variable(name)
        except NotFound:
            return False
        return True

    def __enter__(self: S) -> S:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
