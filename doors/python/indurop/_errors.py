# SPDX-License-Identifier: Apache-2.0
"""Errors of the C interface as exceptions. Their text is the one that irp_error() returns."""

from __future__ import annotations


class Error(Exception):
    """Base of all errors of this package."""


class Invalid(Error, ValueError):
    """An argument is outside of its documented range."""


class NotFound(Error, KeyError):
    """No such node or variable."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


class Denied(Error, PermissionError):
    """No permission, or the node was opened without write=True."""


class WrongSize(Error, ValueError):
    """The buffer has another size than the value."""


class OutOfRange(Error, ValueError):
    """Not a value of this variable: outside of its type or its declared range."""


class Forced(Error):
    """The variable is forced: writing it has no effect."""


class Locked(Error):
    """The node's write lock forbids it."""


class Busy(Error):
    """A process that holds a lock is stopped, or values are written without a pause: try again."""


class Changed(Error):
    """The node has other variables now. The package refreshes its handle automatically; this is raised if that failed."""


class Timeout(Error, TimeoutError):
    """Not within the stated time."""


class Gone(Error):
    """The node has ended."""


class OtherVersion(Error):
    """The node is of a release with another memory layout."""


class Corrupt(Error):
    """The memory was damaged or truncated by a process with write access."""


class Apart(Error):
    """The values do not belong together."""


class SystemFailure(Error):
    """Out of memory, or an error of the operating system."""


class Unreachable(Error, ConnectionError):
    """A server does not answer or its certificate is not trusted; boards of a plant are missing."""


class RolledBack(Error):
    """A deployment was not healthy on all boards: they run what they ran before."""


# By irp_code.
BY_CODE: list[type[Error]] = [Error, Invalid, NotFound, Denied, WrongSize, OutOfRange, Forced, Locked, Busy, Changed,
                              Timeout, Gone, OtherVersion, Corrupt, Apart, SystemFailure]
