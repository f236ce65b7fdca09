# SPDX-License-Identifier: Apache-2.0
"""Data types of IEC 61131-3 as the generator and its oracle see them, and what values of them do at their ends."""

import ctypes
import dataclasses
import math


@dataclasses.dataclass(frozen=True, eq=False)
class Type:
    name: str  # as declared
    kind: str  # bool bits int real time date tod dt string enum array struct
    bits: int = 0
    signed: bool = False
    length: int = 0  # string
    low: int = None  # subrange
    high: int = None
    items: tuple = ()  # enum: (name, value)
    element: object = None  # array
    bounds: tuple = ()  # array: ((low, high), ...)
    fields: tuple = ()  # struct: (name, type)
    base: object = None  # subrange: the type without it
    initial: object = None  # of the declaration: a value
    family: str = ""  # of the standard function names

    @property
    def plain(self):
        """The elementary type that expressions of this type have."""
        return self.base or self

    def least(self):
        return -(1 << (self.bits - 1)) if self.signed else 0

    def greatest(self):
        return (1 << (self.bits - 1)) - 1 if self.signed else (1 << self.bits) - 1


BOOL = Type("BOOL", "bool", 1)
BITS = [Type(n, "bits", b) for n, b in (("BYTE", 8), ("WORD", 16), ("DWORD", 32), ("LWORD", 64))]
PART_LETTERS = {8: "B", 16: "W", 32: "D"}  # of w.%B1
SIGNED = [Type(n, "int", b, True) for n, b in (("SINT", 8), ("INT", 16), ("DINT", 32), ("LINT", 64))]
UNSIGNED = [Type(n, "int", b, False) for n, b in (("USINT", 8), ("UINT", 16), ("UDINT", 32), ("ULINT", 64))]
INTS = SIGNED + UNSIGNED
REAL, LREAL = Type("REAL", "real", 32), Type("LREAL", "real", 64)
REALS = [REAL, LREAL]
TIME, DATE = Type("TIME", "time", 64, True), Type("DATE", "date", 64, True)
TOD, DT = Type("TIME_OF_DAY", "tod", 64, True), Type("DATE_AND_TIME", "dt", 64, True)
TIMES = [TIME, DATE, TOD, DT]
STRING = Type("STRING", "string", length=80)
INT, DINT = SIGNED[1], SIGNED[2]
ELEMENTARY = [BOOL, *BITS, *INTS, *REALS, *TIMES, STRING]

DAY = 24 * 3600 * 10**9
MOST_DAYS = ((1 << 63) - 1) // DAY


def string(length):
    return Type(f"STRING[{length}]", "string", length=length)


def widens(source, target):
    """Whether a value becomes one of the other type without a conversion."""
    if source is target:
        return True
    if source.kind == target.kind == "string":
        return True
    if source.kind == "bits" and target.kind == "bits":
        return source.bits < target.bits
    if source.kind == "int" and target.kind == "int":
        if source.signed == target.signed:
            return source.bits < target.bits
        return target.signed and source.bits < target.bits
    if source.kind == "int" and target.kind == "real":
        return source.bits < target.bits
    return source is REAL and target is LREAL


def common(a, b):
    """The one of both that the other widens to; None if there is none."""
    if a.kind == b.kind == "string":
        return a if a.length >= b.length else b
    return b if widens(a, b) else a if widens(b, a) else None


def single(x):
    """A float rounded to a REAL."""
    return ctypes.c_float(x).value


def real_of(type_, x):
    """Any number as a REAL or LREAL, rounded once."""
    if type_ is LREAL or isinstance(x, float) or abs(x) < 1 << 53:
        return single(x) if type_ is REAL else float(x)
    size = abs(x)
    drop = size.bit_length() - 24
    kept, rest = size >> drop, size & ((1 << drop) - 1)
    half = 1 << (drop - 1)
    kept += rest > half or (rest == half and kept & 1)
    return math.copysign(math.ldexp(kept, drop), x)


def wrap(type_, x):
    """The low bits of an integer as this type."""
    x &= (1 << type_.bits) - 1
    return x - (1 << type_.bits) if type_.signed and x >> (type_.bits - 1) else x


def saturate(type_, x):
    """A float to the nearest integer of the type, halves to the even one; NaN is 0."""
    if math.isnan(x):
        return 0
    if math.isinf(x):
        return type_.greatest() if x > 0 else type_.least()
    return min(max(round(x), type_.least()), type_.greatest())


def widen(source, target, value):
    """The value of `source` as the wider `target`."""
    return real_of(target, value) if target.kind == "real" and source is not target else value


def stored(type_, value):
    """A value as a variable of the type keeps it: a text is cut."""
    if type_.kind == "string":
        return value[:type_.length]
    return value


def zero(type_):
    """The initial value where none is written."""
    if type_.initial is not None:
        return clone(type_.initial)
    if type_.kind == "array":
        return rows(type_, 0)
    if type_.kind == "struct":
        return {name: zero(of) for name, of in type_.fields}
    if type_.kind == "enum":
        return type_.items[0][1]
    if type_.low is not None:
        return type_.low if type_.low > 0 or type_.high < 0 else 0
    return {"bool": False, "real": 0.0, "string": ""}.get(type_.kind, 0)


def rows(type_, level):
    low, high = type_.bounds[level]
    last = level + 1 == len(type_.bounds)
    return [zero(type_.element) if last else rows(type_, level + 1) for _ in range(low, high + 1)]


def clone(value):
    if isinstance(value, list):
        return [clone(one) for one in value]
    if isinstance(value, dict):
        return {name: clone(one) for name, one in value.items()}
    return value
