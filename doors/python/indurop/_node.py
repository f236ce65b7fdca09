# SPDX-License-Identifier: Apache-2.0
"""A node of this machine and its variables."""

from __future__ import annotations

import asyncio
import time
from dataclasses import dataclass
from typing import Any, AsyncIterator, Iterator, Mapping

from indurop import _layout
from indurop._binding import ffi, lib
from indurop._by_name import ByName
from indurop._described import Described
from indurop._errors import Error, Gone, Invalid, Timeout
from indurop._library import CHANGED, check, error, text

_ASYNC_POLL_S = 0.001  # between two reads of an asyncio watch


def held_ns(seconds: float) -> int:
    """Of a force, in ns. 0 means until it is released, so what is less than 1 ns is not 0."""
    if not 0 <= seconds < 9e9:
        raise Invalid(f"a value is forced for 0 s or more, up to 9e9 s, not for {seconds} s")
    return max(1, int(seconds * 1e9)) if seconds > 0 else 0


@dataclass
class Quality:
    """How good a value is."""

    forced: bool  # a part of it is forced
    remote: bool  # another board owns it
    silent: bool  # that board is silent: the value is the last one, or its fallback
    never: bool  # no value of that board was received yet
    confirmed: float  # seconds since the owning board last confirmed the value

    @property
    def good(self) -> bool:
        return not (self.forced or self.silent or self.never)


class Variable(Described):
    """A variable or a part of one. It stays valid when a deployment gives the node other variables, as long as its name
    and type are the same."""

    def __init__(self, node: "Node", id_: int) -> None:
        self._node = node
        self._id = id_
        self._describe()

    def _describe(self) -> None:
        about = ffi.new("irp_variable*")
        about.struct_size = ffi.sizeof("irp_variable")
        check(lib.irp_describe(self._node._handle, self._id, about))
        self._take(about)
        self._bytes = bytearray(self.size)
        self._buffer = ffi.from_buffer(self._bytes)
        self._reading = ffi.new("reading*", (self._node._handle, self._id, self._buffer, self.size))
        self._array: Any = None
        self._record: Any = None
        code: Any = self.layout.code  # a newer mypy wants one of the letters that cast() knows, not any str
        self._number = memoryview(self._bytes).cast(code) if code is not None and code != "c" else None

    def read(self) -> memoryview:
        """Reads the value and returns its bytes: always the same buffer, with the newest value."""
        code = lib.read_again(self._reading)
        if code != 0:
            self._node._recover(code)
            check(lib.read_again(self._reading))
        return memoryview(self._bytes)

    @property
    def value(self) -> Any:
        """The value as Python sees it: bool, int, float, str, an enum's member, Record, or lists of them."""
        if lib.read_again(self._reading) != 0:
            self.read()
        number = self._number
        return number[0] if number is not None else self.layout.value(self._bytes)

    @value.setter
    def value(self, value: Any) -> None:
        self.write(value)

    def value_of(self, data: bytes) -> Any:
        """Returns the value that these bytes stand for."""
        return self.layout.value(data)

    def numpy(self) -> Any:
        """Reads the value and returns a numpy array or record on the buffer of read(): no copy, and the next read
        changes it."""
        self.read()
        if self._array is None:
            import numpy

            layout = self.layout
            element = _layout.Layout(layout.base, layout.element_size, [], layout.fields, layout.names)
            flat = numpy.frombuffer(self._bytes, dtype=element.dtype())
            self._array = flat.reshape(layout.dims) if layout.dims else flat
            # An element that is a struct shares the bytes, a number is a copy.
            self._record = flat[0] if not layout.dims and layout.base == "struct" else None
        if self._record is not None:
            return self._record
        return self._array if self.layout.dims else self._array[0]

    def _packed(self, value: Any) -> Any:
        data = bytearray(self.read())
        self.layout.store(value, data)
        return ffi.from_buffer(data)

    def write(self, value: Any, reason: str = "") -> None:
        """Sets the value once. Fields that a dict leaves out keep their values."""
        check(
            lib.irp_write(self._node._handle, self._id, self._packed(value), self.size, reason.encode()))

    def force(self, value: Any, seconds: float = 0, reason: str = "") -> None:
        """Holds the value against all writers, for `seconds` or, 0, until it is released."""
        check(
            lib.irp_force(self._node._handle, self._id, self._packed(value), self.size, held_ns(seconds), reason.encode()))

    def release(self, reason: str = "") -> None:
        check(lib.irp_release(self._node._handle, self._id, reason.encode()))

    @property
    def quality(self) -> Quality:
        found = ffi.new("irp_quality*")
        found.struct_size = ffi.sizeof("irp_quality")
        check(lib.irp_get_quality(self._node._handle, self._id, found))
        flags = found.flags
        return Quality(bool(flags & 1), bool(flags & 2), bool(flags & 4), bool(flags & 8), found.confirmed_ns / 1e9)

    def watch(self, timeout: float | None = None) -> Iterator[Any]:
        """Yields the value now and after each change; changes within 500 us are one. Ends with the node; raises Timeout
        if nothing changed for `timeout` seconds."""
        seen = ffi.new("uint64_t*")
        last = None
        while True:
            try:
                # Not longer, so that Ctrl-C is noticed.
                changed = self._changed(seen, 0.1 if timeout is None else timeout)
                # What was noticed may be newer than what was read before.
                if changed and (now := bytes(self.read())) != last:
                    last = now
                    yield self.value_of(now)
                elif not changed and timeout is not None:
                    raise Timeout(f"{self.name} did not change")
            except Gone:
                return

    async def watch_async(self) -> AsyncIterator[Any]:
        """The same for asyncio; changes within a millisecond are one."""
        seen = ffi.new("uint64_t*")
        last = None
        while True:
            try:
                if self._changed(seen, 0) and (now := bytes(self.read())) != last:
                    last = now
                    yield self.value_of(now)
            except Gone:
                return
            await asyncio.sleep(_ASYNC_POLL_S)

    def _changed(self, seen: Any, timeout: float) -> bool:
        code = lib.irp_wait_change(self._node._handle, self._id, seen, int(timeout * 1e9))
        if code == CHANGED:
            self._node.refresh()
            return True
        try:
            check(code)
        except Timeout:
            return False
        return True


class Stream:
    """Every run of the modules that write some variables, from the node's tape, without a gap as long as `lost` is 0.
    Iterating yields numpy arrays of rows with the fields `@tick`, `@time` (ns of the node's clock) and the names given.
    Needs numpy."""

    def __init__(self, node: "Node", names: tuple[str, ...], past: bool) -> None:
        import numpy

        self._node = node
        variables = [node.variable(name) for name in names]
        self.dtype = numpy.dtype([("@tick", "u8"), ("@time", "i8")]
                                 + [(name, one.layout.dtype()) for name, one in zip(names, variables)])
        fields: Any = self.dtype.fields
        self._offsets = ffi.new("size_t[]", [fields[name][1] for name in names])
        self._taken = ffi.new("size_t*")
        stream = ffi.new("irp_stream**")
        ids = ffi.new("uint32_t[]", [one._id for one in variables])
        check(lib.irp_stream_open(node._handle, ids, len(names), 1 if past else 0, stream))
        self._stream = ffi.gc(stream[0], lib.irp_stream_close)

    def read(self, most: int = 4096, timeout: float = 1.0) -> Any:
        """Returns the rows that are ready, at most `most`; waits for one if there is none. Raises Timeout, Gone after
        the last row of a node that has ended, and Changed."""
        import numpy

        rows = numpy.empty(most, self.dtype)
        check(lib.irp_stream_read(self._stream, ffi.from_buffer(rows), self.dtype.itemsize, self._offsets,
                                              most, int(timeout * 1e9), self._taken))
        return rows[:self._taken[0]]

    def __iter__(self) -> Iterator[Any]:
        while True:
            try:
                yield self.read(timeout=0.1)  # not longer, so that Ctrl-C is noticed
            except Timeout:
                continue
            except Gone:
                return

    @property
    def lost(self) -> int:
        """Runs that were overwritten before they were read."""
        return int(lib.irp_stream_lost(self._stream))

    def close(self) -> None:
        ffi.release(self._stream)

    def __enter__(self) -> "Stream":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Node(ByName[Variable]):
    """A node of this machine. `node["name"]` reads a value, `node["name"] = value` sets it; names may leave leading
    namespaces out, and name parts: "joints[1].y"."""

    def __init__(self, name: str = "", write: bool = False) -> None:
        handle = ffi.new("irp_node**")
        self._handle: Any = ffi.NULL
        check(lib.irp_open(name.encode(), 1 if write else 0, handle))
        self._handle = ffi.gc(handle[0], lib.irp_close)
        self._known: dict[str, Variable] = {}
        self.name = text(lib.irp_node_name(self._handle))

    def _recover(self, code: int) -> None:
        if code != CHANGED:
            raise error(code)
        self.refresh()

    def close(self) -> None:
        """Ends the use of the node; variables of it cannot be used afterwards."""
        ffi.release(self._handle)
        self._handle = ffi.NULL
        self._known.clear()

    @property
    def running(self) -> bool:
        code = lib.irp_running(self._handle)
        if code == CHANGED:
            self.refresh()
            code = lib.irp_running(self._handle)
        return bool(code == 0)

    def refresh(self) -> None:
        """Takes the variables that a deployment gave the node. Reads do this automatically."""
        deadline = time.monotonic() + 2
        while True:
            code = lib.irp_refresh(self._handle)
            if code == 0:
                break
            if time.monotonic() > deadline:
                raise error(code)
            time.sleep(0.01)
        self._known = {name: one for name, one in self._known.items() if self._still(one)}

    def _still(self, one: Variable) -> bool:
        about = ffi.new("irp_variable*")
        about.struct_size = ffi.sizeof("irp_variable")
        return bool(lib.irp_describe(self._handle, one._id, about) == 0)

    def _find(self, name: str) -> Variable:
        id_ = ffi.new("uint32_t*")
        code = lib.irp_find(self._handle, name.encode(), id_)
        if code == CHANGED:
            self.refresh()
            code = lib.irp_find(self._handle, name.encode(), id_)
        check(code)
        return Variable(self, id_[0])

    def __getitem__(self, name: str) -> Any:
        return self.variable(name).value

    def __setitem__(self, name: str, value: Any) -> None:
        self.variable(name).write(value)

    def __contains__(self, name: str) -> bool:
        try:
            self.variable(name)
        except Error:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        self.refresh()
        return (text(lib.irp_name(self._handle, i)) for i in range(len(self)))

    def __len__(self) -> int:
        return int(lib.irp_count(self._handle))

    def keys(self) -> list[str]:
        return list(self)

    def snapshot(self, *names: str) -> Mapping[str, Any]:
        """Reads several values as they were at one moment, by the names given. Raises Apart if they do not belong
        together."""
        variables = [self.variable(name) for name in names]
        to = ffi.new("void*[]", [one._buffer for one in variables])
        ids = ffi.new("uint32_t[]", [one._id for one in variables])
        sizes = ffi.new("size_t[]", [one.size for one in variables])
        code = lib.irp_read_together(self._handle, ids, len(names), to, sizes)
        if code == CHANGED:
            self.refresh()
            return self.snapshot(*names)
        check(code)
        return {name: one.layout.value(one._bytes) for name, one in zip(names, variables)}

    def stream(self, *names: str, past: bool = False) -> Stream:
        """Follows variables run by run; `past`: begins with the oldest run on the tape, two seconds ago or more."""
        return Stream(self, names, past)

    def __repr__(self) -> str:
        return f"<node {self.name}, {len(self)} variables>"


def node(name: str = "", write: bool = False) -> Node:
    """Opens a node. Without a name: $INDUROP_NODE, else of the running nodes "local" or the only one."""
    return Node(name, write)
