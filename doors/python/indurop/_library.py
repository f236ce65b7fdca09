# SPDX-License-Identifier: Apache-2.0
"""The C library: its errors as exceptions, its texts."""

from __future__ import annotations

from typing import Any

from indurop._binding import ffi, lib
from indurop._errors import BY_CODE, Error

CHANGED = 9


def version() -> str:
    """Returns the version of the library, "0.2.0"."""
    return text(lib.irp_version())


def error(code: int) -> Error:
    return BY_CODE[code](text(lib.irp_error()))


def check(code: int) -> None:
    if code != 0:
        raise error(code)


def text(chars: Any) -> str:
    return str(ffi.string(chars).decode("utf-8", "replace"))
