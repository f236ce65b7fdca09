# SPDX-License-Identifier: Apache-2.0
"""Values written as the text of a program has them, in the many forms that the standard allows."""

import math

import calendar_rules
from kinds import REAL, single
from tree import PRIMARY, SIGN, Expr


def digits(rng, size):
    """A whole number that is not negative."""
    form = rng.random()
    if form < 0.75:
        text = str(size)
        return text[:-3] + "_" + text[-3:] if len(text) > 4 and rng.random() < 0.3 else text
    if form < 0.9:
        return f"16#{size:X}"
    return f"2#{size:b}" if form < 0.95 else f"8#{size:o}"


def real_text(type_, value):
    text = f"{value:.9g}" if type_ is REAL else repr(value)
    mantissa, _, exponent = text.partition("e")
    if "." not in mantissa:
        mantissa += ".0"
    return mantissa + (f"E{int(exponent)}" if exponent else "")


def quoted(text):
    out = ""
    for c in text:
        out += {"'": "$'", "$": "$$", "\n": "$L", "\t": "$T"}.get(c, c if " " <= c <= "~" else f"${ord(c):02X}")
    return f"'{out}'"


def duration(rng, ns):
    """T#1d2h3m4s5ms6us7ns, the first parts left out or not: only the first number may overflow."""
    out, rest = "", abs(ns)
    for unit, size in (("d", 86400 * 10**9), ("h", 3600 * 10**9), ("m", 60 * 10**9), ("s", 10**9), ("ms", 10**6),
                       ("us", 10**3), ("ns", 1)):
        if rest >= size and (out or rng.random() < 0.8 or unit == "ns" or rest % size):
            out += f"{rest // size}{unit}"
            rest %= size
    return rng.choice(("T#", "TIME#", "t#")) + ("-" if ns < 0 else "") + (out or "0s")


def time_text(rng, type_, ns):
    if type_.kind == "time":
        return duration(rng, ns)
    if type_.kind == "date":
        return rng.choice(("D#", "DATE#")) + calendar_rules.date_text(ns)
    if type_.kind == "tod":
        return rng.choice(("TOD#", "TIME_OF_DAY#")) + calendar_rules.clock_text(ns)
    return rng.choice(("DT#", "DATE_AND_TIME#")) + calendar_rules.date_text(ns) + "-" + calendar_rules.clock_text(ns)


def of_value(rng, type_, value, typed=True):
    """The value as an expression: with its type where the text allows one, and says it if `typed`."""
    plain = type_.plain
    result = lambda text, level=PRIMARY, bare=False: Expr(text, plain, lambda f: value, level, bare=bare)
    if type_.kind == "enum":
        name = next(n for n, v in type_.items if v == value)
        return Expr(f"{type_.name}#{name}" if rng.random() < 0.4 else name, type_, lambda f: value)
    if type_.kind == "bool":
        word = "TRUE" if value else "FALSE"
        return result(rng.choice((word, word, f"BOOL#{int(value)}", f"BOOL#{word}")))
    if type_.kind == "string":
        return result(quoted(value))
    if type_.kind in ("time", "date", "tod", "dt"):
        return result(time_text(rng, type_, value))
    if type_.kind == "real":
        negative = math.copysign(1.0, value) < 0
        text = real_text(plain, abs(value))
        if typed:
            return result(f"{plain.name}#{'-' if negative else ''}{text}")
        return result("-" + text, SIGN, True) if negative else result(text, bare=True)
    if typed:
        return result(f"{plain.name}#{'-' if value < 0 else ''}{digits(rng, abs(value))}")
    return result("-" + digits(rng, -value), SIGN, True) if value < 0 else result(digits(rng, value), bare=True)


def some_value(rng, type_):
    """A value of the type; often one at its ends."""
    if type_.kind == "bool":
        return rng.random() < 0.5
    if type_.kind == "enum":
        return rng.choice(type_.items)[1]
    if type_.kind == "string":
        most = min(type_.length, 12)
        return "".join(rng.choice("abcXYZ 0123456789-_'$#\n.") for _ in range(rng.randint(0, most)))
    if type_.low is not None:
        return rng.choice((type_.low, type_.high, rng.randint(type_.low, type_.high)))
    if type_.kind in ("int", "bits"):
        ends = (0, 1, 2, 7, type_.greatest(), type_.least(), type_.greatest() - 1, rng.randint(0, 100))
        if rng.random() < 0.75:
            return rng.choice(ends + ((-1, -3) if type_.signed else ()))
        return rng.randint(type_.least(), type_.greatest())
    if type_.kind == "real":
        value = rng.choice((0.0, 1.0, -1.0, 0.5, 2.5, 3.5, -7.25, 100.0, 0.1, 1e-5, 123456.0, 3.0e9, 1e20, -1e-20,
                            rng.uniform(-10, 10), rng.uniform(-1000, 1000), 3.4e38 if rng.random() < 0.2 else 1e10))
        return single(value) if type_.plain is REAL else value
    if type_.kind == "time":
        return rng.choice((0, 10**9, 10**6 * rng.randint(-500, 5000), 1500, -1, 90 * 86400 * 10**9, rng.randint(0, 10**12)))
    if type_.kind == "tod":
        return rng.choice((0, 86400 * 10**9 - 1, 10**6 * rng.randint(0, 86399999)))
    days = rng.choice((0, 1, 19782, -1, -106751, 106750, rng.randint(-106751, 106750)))
    if type_.kind == "date":
        return days * 86400 * 10**9
    return days * 86400 * 10**9 + rng.choice((0, 10**6 * rng.randint(0, 86399999)))
