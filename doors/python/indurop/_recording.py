# SPDX-License-Identifier: Apache-2.0
"""Recordings as numpy arrays and pandas tables."""

from __future__ import annotations

import os
import warnings
from typing import Any, Iterator, NamedTuple, Sequence

from indurop import _layout
from indurop._binding import ffi, lib
from indurop._by_name import ByName
from indurop._described import Described
from indurop._errors import Invalid
from indurop._library import check, text

_MOST_BYTES = 4 << 20  # of the values that are taken at a time
_LATEST = (1 << 63) - 1


class Samples(NamedTuple):
    """The values of one variable over time, two numpy arrays of the same length."""

    time: Any  # int64: ns since 1970, of a simulation its virtual time
    value: Any


class RecordedVariable(Described):
    """A variable of a recording, or a part of one."""

    def __init__(self, recording: "Recording", id_: int) -> None:
        self._id = id_
        about = ffi.new("irp_variable*")
        about.struct_size = ffi.sizeof("irp_variable")
        check(lib.irp_recording_describe(recording._handle, id_, about))
        self._take(about)


class Recording(ByName[RecordedVariable]):
    """The variables of a recording over time. Names may leave leading namespaces out, and name parts. Of a file of
    several boards a name begins with its board: "sensor/encoder". Needs numpy.

    What is damaged in the file is left out, and warned of. For one thread at a time."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        handle = ffi.new("irp_recording**")
        self._handle: Any = ffi.NULL
        check(lib.irp_recording_open(os.fsencode(path), handle))
        self._handle = ffi.gc(handle[0], lib.irp_recording_close)
        self._known: dict[str, RecordedVariable] = {}
        self.path = os.fspath(path)
        self.damages: list[str] = []  # parts that are missing, as far as the file was read
        self._note_damages()

    def close(self) -> None:
        ffi.release(self._handle)
        self._handle = ffi.NULL
        self._known.clear()

    def _note_damages(self) -> None:
        while (damage := lib.irp_recording_damage(self._handle, len(self.damages))) != ffi.NULL:
            self.damages.append(text(damage))
            warnings.warn(self.damages[-1], RuntimeWarning, stacklevel=3)

    @property
    def span(self) -> tuple[int, int]:
        """Times of the first and the last sample, ns."""
        times = ffi.new("int64_t[2]")
        check(lib.irp_recording_span(self._handle, times, times + 1))
        return int(times[0]), int(times[1])

    def _find(self, name: str) -> RecordedVariable:
        id_ = ffi.new("uint32_t*")
        check(lib.irp_recording_find(self._handle, name.encode(), id_))
        return RecordedVariable(self, id_[0])

    def __iter__(self) -> Iterator[str]:
        return (text(lib.irp_recording_name(self._handle, i)) for i in range(len(self)))

    def __len__(self) -> int:
        return int(lib.irp_recording_count(self._handle))

    def keys(self) -> list[str]:
        return list(self)

    def __getitem__(self, name: str) -> Samples:
        """The value of a variable at each time at which it changed."""
        return self.samples(name)[name]

    def samples(self, *names: str, begin: int = 0, end: int = _LATEST, repeats: bool = False) -> dict[str, Samples]:
        """Reads several variables (all, without a name) in one pass: of each the times at which it changed, from `begin`
        to `end` (ns), and its values then. `repeats`: also samples that repeat the value, since each module that uses a
        variable records it."""
        import numpy

        names = names or tuple(self)
        variables = [self.variable(name) for name in names]
        ids = ffi.new("uint32_t[]", [one._id for one in variables])
        check(lib.irp_recording_select(self._handle, ids, len(variables), begin, end, repeats))
        stride = max((one.size for one in variables), default=1)
        most = max(1, min(1 << 16, _MOST_BYTES // stride))
        times = numpy.empty(most, "i8")
        which = numpy.empty(most, "u4")
        values = numpy.empty((most, stride), "u1")
        taken = ffi.new("size_t*", most)
        found: list[tuple[list[Any], list[Any]]] = [([], []) for _ in variables]
        while taken[0] == most:
            check(lib.irp_recording_read(self._handle, ffi.from_buffer("int64_t[]", times),
                                         ffi.from_buffer("uint32_t[]", which), ffi.from_buffer(values), stride, most,
                                         taken))
            for i, one in enumerate(variables):
                chosen = numpy.flatnonzero(which[:taken[0]] == i)
                found[i][0].append(times[chosen])
                found[i][1].append(values[chosen, :one.size])
        self._note_damages()
        return {name: Samples(numpy.concatenate(time), _of_bytes(one.layout, numpy.concatenate(value)))
                for name, one, (time, value) in zip(names, variables, found)}

    def rows(self, *names: str, every: float | None = None) -> Any:
        """Returns a numpy array with the fields `@time` (ns) and the names given (all, without a name): a row for each
        time at which one of them changed, or each `every` seconds, with the values that hold then. It begins when all
        are known."""
        import numpy

        names = names or tuple(self)
        samples = self.samples(*names)
        dtype = numpy.dtype([("@time", "i8")] + [(name, self.variable(name).layout.dtype()) for name in names])
        if not samples or any(len(one.time) == 0 for one in samples.values()):
            return numpy.empty(0, dtype)
        times = _times([one.time for one in samples.values()], every)
        rows = numpy.empty(len(times), dtype)
        rows["@time"] = times
        for name, one in samples.items():
            rows[name] = one.value[numpy.searchsorted(one.time, times, side="right") - 1]
        return rows

    def frame(self, *names: str, every: float | None = None) -> Any:
        """Returns rows() as a pandas DataFrame over the time of day (UTC), with a column for each number and text:
        "gain", "joints[1].y". Enums are numbers; `frame.attrs["units"]` has the units. Needs pandas."""
        import pandas

        names = names or tuple(self)
        rows = self.rows(*names, every=every)
        columns: dict[str, Any] = {}
        units: dict[str, str] = {}
        for name in names:
            one = self.variable(name)
            for column, values in one.layout.columns(name, rows[name]):
                columns[column] = values
                units[column] = one.unit
        frame = pandas.DataFrame(columns, index=pandas.to_datetime(rows["@time"], utc=True))
        frame.index.name = "time"
        frame.attrs["units"] = units
        return frame

    def __repr__(self) -> str:
        return f"<recording {self.path}, {len(self)} variables>"


def _of_bytes(layout: _layout.Layout, values: Any) -> Any:
    """Bytes, a row for each value, as values."""
    element = _layout.Layout(layout.base, layout.element_size, [], layout.fields, layout.names)
    return values.reshape(-1).view(element.dtype()).reshape(len(values), *layout.dims)


def _times(samples: Sequence[Any], every: float | None) -> Any:
    """Times of rows, from the one on at which all are known."""
    import numpy

    if every is None:
        times = numpy.unique(numpy.concatenate(samples))
    else:
        step = int(every * 1e9)
        if step <= 0:
            raise Invalid(f"rows every {every} s: a time above 0 is needed")
        times = numpy.arange(min(one[0] for one in samples), max(one[-1] for one in samples) + 1, step)
    return times[times >= max(one[0] for one in samples)]


def recording(path: str | os.PathLike[str]) -> Recording:
    """Opens a recording of `indurop record` or `indurop run --record`, with its present content."""
    return Recording(path)
