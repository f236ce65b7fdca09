# SPDX-License-Identifier: Apache-2.0
"""The standard functions, as docs/plc_library.md describes them."""

import ctypes
import ctypes.util
import math

import calendar_rules
from kinds import REAL, TIME, real_of, saturate, wrap
from tree import Fault

libm = ctypes.CDLL(ctypes.util.find_library("m"))


def of_libm(name, type_, *values):
    """The C library's function of this type, which is what programs call."""
    c = ctypes.c_float if type_ is REAL else ctypes.c_double
    function = getattr(libm, name + ("f" if type_ is REAL else ""))
    function.restype, function.argtypes = c, [c] * len(values)
    return function(*values)


def power(type_, x, n):
    libm.pow.restype, libm.pow.argtypes = ctypes.c_double, [ctypes.c_double] * 2
    return real_of(type_, libm.pow(float(x), float(n)))


def arithmetic(op, type_, a, b):
    if type_.kind == "real":
        return real_of(type_, {"+": lambda: a + b, "-": lambda: a - b, "*": lambda: a * b, "/": lambda: quotient(a, b)}[op]())
    if op in ("/", "MOD"):
        if b == 0:
            raise Fault("MOD by zero" if op == "MOD" else "division by zero")
        whole = abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
        return wrap(type_, whole if op == "/" else a - whole * b)
    return wrap(type_, {"+": lambda: a + b, "-": lambda: a - b, "*": lambda: a * b}[op]())


def quotient(a, b):
    if b == 0:
        raise Fault("division by zero")
    return a / b


def negated(type_, x):
    return -x if type_.kind == "real" else wrap(type_, -x)


def absolute(type_, x):
    return math.fabs(x) if type_.kind == "real" else wrap(type_, abs(x))


def maximum(*values):
    result = values[0]
    for one in values[1:]:
        result = one if one > result else result
    return result


def minimum(*values):
    result = values[0]
    for one in values[1:]:
        result = one if one < result else result
    return result


def limit(low, x, high):
    return minimum(maximum(x, low), high)


def selected(second, a, b):
    """SEL; what it chooses from is computed in any case."""
    return b if second else a


def mux(k, *values):
    if not 0 <= k < len(values):
        raise Fault("selector K of MUX")
    return values[k]


COMPARE = {"<": lambda a, b: a < b, ">": lambda a, b: a > b, "<=": lambda a, b: a <= b, ">=": lambda a, b: a >= b,
           "=": lambda a, b: a == b, "<>": lambda a, b: a != b}


def chain(op, values):
    return all(COMPARE[op](a, b) for a, b in zip(values, values[1:]))


def shifted(name, type_, x, n):
    bits = type_.bits
    if name in ("ROL", "ROR"):
        n = (n if name == "ROL" else -n) % bits
        x = int(x)
        out = (x << n | x >> (bits - n)) & ((1 << bits) - 1)
    elif n <= 0:
        out = int(x)
    elif n >= bits:
        out = 0
    else:
        out = (int(x) << n) & ((1 << bits) - 1) if name == "SHL" else int(x) >> n
    return bool(out) if type_.kind == "bool" else out


def bitwise(op, type_, a, b):
    out = {"AND": a & b, "OR": a | b, "XOR": a ^ b}[op]
    return bool(out) if type_.kind == "bool" else out


def inverted(type_, x):
    return not x if type_.kind == "bool" else x ^ ((1 << type_.bits) - 1)


# Times

def time_sum(type_, ns, add):
    """A time or date plus a duration."""
    if type_.kind == "tod":
        return (ns + add) % calendar_rules.DAY
    return wrap(TIME, ns + add)


def scaled(ns, factor, divide):
    if divide and factor == 0:
        raise Fault("division by zero")
    if isinstance(factor, float):
        return saturate(TIME, ns / factor if divide else ns * factor)
    if not divide:
        return wrap(TIME, ns * factor)
    whole = abs(ns) // abs(factor)
    return wrap(TIME, whole if (ns < 0) == (factor < 0) else -whole)


# Texts: positions count from 1, what reaches beyond the text means the part that exists.

def cut(text, first, length):
    begin = min(max(first - 1, 0), len(text))
    end = min(max(first - 1 + max(length, 0), begin), len(text))
    return text[:begin], text[begin:end], text[end:]


def left(text, n):
    return cut(text, 1, n)[1]


def right(text, n):
    n = min(max(n, 0), len(text))
    return text[len(text) - n:]


def mid(text, n, first):
    return cut(text, first, n)[1]


def insert(text, other, after):
    before, _, rest = cut(text, after + 1, 0)
    return before + other + rest


def delete(text, n, first):
    before, _, rest = cut(text, first, n)
    return before + rest


def replace(text, other, n, first):
    before, _, rest = cut(text, first, n)
    return before + other + rest


def find(text, other):
    return text.find(other) + 1 if other else 0


def truncated(type_, x):
    return saturate(type_, math.trunc(x) if math.isfinite(x) else x) if isinstance(x, float) else x


def from_bcd(type_, x, bits):
    value = 0
    for shift in range(bits - 4, -1, -4):
        value = value * 10 + (x >> shift & 15)
    return wrap(type_, value)


def to_bcd(x, bits):
    out, rest = 0, x & ((1 << 64) - 1)
    for shift in range(0, bits, 4):
        out |= rest % 10 << shift
        rest //= 10
    return out
