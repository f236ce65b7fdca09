# SPDX-License-Identifier: Apache-2.0
"""Layouts as irp_describe() states them ("struct(24,8){x@0:f64,y@8:f64,z@16:f64}[10]"), and bytes to Python values and
back. The grammar is in <indurop/c.h>."""

from __future__ import annotations

import enum
import math
import struct
from dataclasses import dataclass, field
from typing import Any, Iterator, cast

from indurop._errors import OutOfRange

_CODES = {"bool": "?", "char": "c", "i8": "b", "u8": "B", "i16": "h", "u16": "H", "i32": "i", "u32": "I", "i64": "q",
          "u64": "Q", "f32": "f", "f64": "d"}


class Record:
    """A struct: its fields are attributes. Changing one changes this copy; assign it to the node to write it."""

    def __init__(self, **fields: Any) -> None:
        self.__dict__.update(fields)

    def __getattr__(self, name: str) -> Any:  # for type checkers: fields are known at run time
        raise AttributeError(f"no field '{name}'; there are {', '.join(self.__dict__)}")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Record) and self.__dict__ == other.__dict__

    def __repr__(self) -> str:
        return "{" + ", ".join(f"{name}: {value!r}" for name, value in self.__dict__.items()) + "}"


@dataclass
class Field:
    name: str
    offset: int
    layout: "Layout"


@dataclass
class Layout:
    """One type: a base and dimensions, outermost first."""

    base: str  # a key of _CODES, "text", "enum" or "struct"
    element_size: int
    dims: list[int] = field(default_factory=list)
    fields: list[Field] = field(default_factory=list)
    names: type[enum.IntEnum] | None = None

    @property
    def size(self) -> int:
        return self.element_size * math.prod(self.dims)

    @property
    def code(self) -> str | None:
        """The code of the struct module, for a single number."""
        return None if self.dims else _CODES.get(self.base)

    def _step(self, dims: list[int]) -> int:
        """Bytes from one value of the outermost dimension to the next."""
        return self.element_size * math.prod(dims[1:])

    def value(self, data: bytes | bytearray | memoryview, offset: int = 0) -> Any:
        return self._values(data, offset, self.dims)

    def _values(self, data: bytes | bytearray | memoryview, offset: int, dims: list[int]) -> Any:
        if not dims:
            return self._element(data, offset)
        step = self._step(dims)
        return [self._values(data, offset + i * step, dims[1:]) for i in range(dims[0])]

    def _element(self, data: bytes | bytearray | memoryview, offset: int) -> Any:
        if self.base == "struct":
            return Record(**{f.name: f.layout.value(data, offset + f.offset) for f in self.fields})
        if self.base == "text":
            return bytes(data[offset:offset + self.element_size]).split(b"\0", 1)[0].decode("utf-8", "replace")
        if self.base == "enum":
            number = struct.unpack_from("=i", data, offset)[0]
            try:
                return self.names(number) if self.names else number
            except ValueError:
                return number
        value = struct.unpack_from("=" + _CODES[self.base], data, offset)[0]
        return value.decode("latin-1") if self.base == "char" else value

    def store(self, value: Any, data: bytearray, offset: int = 0) -> None:
        """Writes a value into `data`. A dict or Record that leaves fields out leaves their bytes as they are. Raises
        OutOfRange for a value that the type cannot hold."""
        self._store(value, data, offset, self.dims)

    def _store(self, value: Any, data: bytearray, offset: int, dims: list[int]) -> None:
        if not dims:
            self._store_element(value, data, offset)
            return
        if isinstance(value, (str, bytes)) or not hasattr(value, "__len__") or len(value) != dims[0]:
            raise OutOfRange(f"{value!r} is not a list of {dims[0]}")
        step = self._step(dims)
        for i, one in enumerate(value):
            self._store(one, data, offset + i * step, dims[1:])

    def _store_element(self, value: Any, data: bytearray, offset: int) -> None:
        if self.base == "struct":
            values = value.__dict__ if isinstance(value, Record) else value
            if not isinstance(values, dict):
                raise OutOfRange(f"{value!r} is not a dict or a Record")
            known = {f.name: f for f in self.fields}
            for name, one in values.items():
                if name not in known:
                    raise OutOfRange(f"no field '{name}'; there are {', '.join(known)}")
                known[name].layout.store(one, data, offset + known[name].offset)
        elif self.base == "text":
            text = self._encoded(value)
            if len(text) >= self.element_size:
                raise OutOfRange(f"a text of {len(text)} bytes; at most {self.element_size - 1}")
            data[offset:offset + self.element_size] = text.ljust(self.element_size, b"\0")
        elif self.base == "enum":
            if isinstance(value, str) and self.names and value in self.names.__members__:
                value = self.names[value]
            self._pack("=i", value, data, offset)
        elif self.base == "char":
            self._pack("=c", value.encode("latin-1") if isinstance(value, str) else value, data, offset)
        elif self.base == "bool" and (isinstance(value, str) or value not in (0, 1)):
            raise OutOfRange(f"{value!r} is not a bool")  # "false" would be true
        else:
            self._pack("=" + _CODES[self.base], value, data, offset)

    @staticmethod
    def _encoded(value: Any) -> bytes:
        if not isinstance(value, str) or "\0" in value:
            raise OutOfRange(f"{value!r} is not a text without NUL")
        try:
            return value.encode()
        except UnicodeEncodeError as error:
            raise OutOfRange(f"{value!r} is not a text: {error}") from error

    def _pack(self, code: str, value: Any, data: bytearray, offset: int) -> None:
        try:
            struct.pack_into(code, data, offset, value)
        except (struct.error, TypeError, OverflowError) as error:
            raise OutOfRange(f"{value!r} is not a value of type {self.base}: {error}") from error

    def columns(self, name: str, values: Any) -> Iterator[tuple[str, Any]]:
        """The numbers and texts of a numpy array of such values, each with its name: "joints[1].y". Texts are str."""
        if self.dims:
            inner = Layout(self.base, self.element_size, self.dims[1:], self.fields, self.names)
            for i in range(self.dims[0]):
                yield from inner.columns(f"{name}[{i}]", values[:, i])
        elif self.base == "struct":
            for f in self.fields:
                yield from f.layout.columns(f"{name}.{f.name}", values[f.name])
        elif self.base in ("text", "char"):
            import numpy

            yield name, numpy.char.decode(values, "utf-8" if self.base == "text" else "latin-1", "replace")
        else:
            yield name, values

    def dtype(self) -> Any:
        """The numpy type with the same bytes. Needs numpy."""
        import numpy

        if self.base == "struct":
            element: Any = numpy.dtype({"names": [f.name for f in self.fields],
                                        "formats": [f.layout.dtype() for f in self.fields],
                                        "offsets": [f.offset for f in self.fields], "itemsize": self.element_size})
        elif self.base == "text":
            element = numpy.dtype(f"S{self.element_size}")
        elif self.base == "enum":
            element = numpy.dtype("i4")
        else:
            code = _CODES[self.base]
            element = numpy.dtype("S1" if code == "c" else "bool" if code == "?" else code)
        return numpy.dtype((element, tuple(self.dims))) if self.dims else element


class _Parser:
    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0

    def until(self, ends: str) -> str:
        begin = self.at
        while self.at < len(self.text) and self.text[self.at] not in ends:
            self.at += 1
        return self.text[begin:self.at]

    def skip(self, text: str) -> bool:
        if not self.text.startswith(text, self.at):
            return False
        self.at += len(text)
        return True

    def need(self, text: str) -> None:
        if not self.skip(text):
            raise ValueError(f"layout '{self.text}': expected '{text}' at {self.at}")

    def layout(self) -> Layout:
        word = self.until("([{,}")
        if word == "text":
            self.need("(")
            layout = Layout("text", int(self.until(")")))
            self.need(")")
        elif word == "enum":
            layout = Layout("enum", 4, names=self.names())
        elif word == "struct":
            layout = self.struct()
        else:
            layout = Layout(word, struct.calcsize("=" + _CODES[word]))
        while self.skip("["):
            layout.dims.append(int(self.until("]")))
            self.need("]")
        return layout

    def names(self) -> type[enum.IntEnum]:
        values: dict[str, int] = {}
        self.need("{")
        while not self.skip("}"):
            name = self.until("=")
            self.need("=")
            values[name] = int(self.until(",}"))
            self.skip(",")
        return cast("type[enum.IntEnum]", enum.IntEnum("Enumeration", values))

    def struct(self) -> Layout:
        self.need("(")
        size = int(self.until(","))
        self.until(")")
        self.need(")")
        self.need("{")
        layout = Layout("struct", size)
        while not self.skip("}"):
            name = self.until("@")
            self.need("@")
            offset = int(self.until(":"))
            self.need(":")
            layout.fields.append(Field(name, offset, self.layout()))
            self.skip(",")
        return layout


def parse(text: str) -> Layout:
    parser = _Parser(text)
    layout = parser.layout()
    if parser.at != len(text):
        raise ValueError(f"layout '{text}': unexpected '{text[parser.at:]}'")
    return layout
