# SPDX-License-Identifier: Apache-2.0
"""X_TO_Y, as docs/plc_library.md describes it."""

import calendar_rules
from kinds import REAL, TIME, TIMES, real_of, saturate, single, wrap

UNIT = {"time": 10**6, "tod": 10**6, "date": 10**9, "dt": 10**9}  # ns in the number 1


def convert(source, target, value):
    if source is target:
        return value
    if target.kind == "string":
        return text_of(source, value)
    if source.kind == "string":
        return whole_number(target, value)
    if target in TIMES:
        return time_of(source, target, value)
    if target.kind == "bool":
        return value != 0
    if source in TIMES:
        if target.kind == "real":
            return real_of(target, value / float(UNIT[source.kind]))
        size = abs(value) // UNIT[source.kind]
        return wrap(target, -size if value < 0 else size)
    if target.kind == "real":
        return real_of(target, int(value) if isinstance(value, bool) else value)
    if source.kind == "real":
        return saturate(target, value)
    return wrap(target, int(value))


def time_of(source, target, value):
    if source in TIMES:
        return calendar_rules.normalized(target, value)
    unit = UNIT[target.kind]
    if source.kind == "real":
        return calendar_rules.normalized(target, saturate(TIME, value * float(unit)))
    return calendar_rules.normalized(target, wrap(TIME, wrap(TIME, int(value)) * unit))


def text_of(source, value):
    if source.kind == "bool":
        return "TRUE" if value else "FALSE"
    if source.kind == "real":
        return real_text(source, value)
    if source.kind == "time":
        return calendar_rules.duration_text(value)
    if source.kind == "date":
        return "D#" + calendar_rules.date_text(value)
    if source.kind == "tod":
        return "TOD#" + calendar_rules.clock_text(value)
    if source.kind == "dt":
        return "DT#" + calendar_rules.date_text(value) + "-" + calendar_rules.clock_text(value)
    return f"16#{value:x}" if source.kind == "bits" else str(value)


def shortest(type_, size):
    """The fewest digits that read back as the same value, and the exponent of the first."""
    for count in range(1, 18):
        text = f"{size:.{count - 1}e}"
        if (single(float(text)) if type_ is REAL else float(text)) == size:
            break
    mantissa, _, exponent = text.partition("e")
    return mantissa.replace(".", "").rstrip("0") or "0", int(exponent)


def real_text(type_, value):
    """'1.5', '1.0e+30': whatever of the two forms is shorter, with a point."""
    if value != value:
        return "NaN"
    if value in (float("inf"), float("-inf")):
        return "INF" if value > 0 else "-INF"
    digits, exponent = shortest(type_, abs(value))
    sign = "-" if str(value).startswith("-") else ""
    scientific = digits[0] + ("." + digits[1:] if len(digits) > 1 else "") + f"e{'-' if exponent < 0 else '+'}{abs(exponent):02}"
    if exponent < 0:
        fixed = "0." + "0" * (-exponent - 1) + digits
    elif len(digits) > exponent + 1:
        fixed = digits[:exponent + 1] + "." + digits[exponent + 1:]
    else:
        fixed = str(int(abs(value)))
    if value == 0:
        fixed, scientific = "0", "0e+00"
    text = fixed if len(fixed) <= len(scientific) else scientific
    mantissa, e, rest = text.partition("e")
    return sign + mantissa + ("" if "." in mantissa else ".0") + e + rest


def whole_number(target, text):
    """What stands at the beginning, after blanks; beyond the range its nearest end."""
    text = text.lstrip(" \t")
    negative = text.startswith("-")
    text = text[1:] if text[:1] in ("+", "-") else text
    size, rest = digits_of(text, 10)
    if size in (2, 8, 16) and rest.startswith("#"):
        size, rest = digits_of(rest[1:], size)
    if negative:
        return max(-size, target.least())
    return min(size, target.greatest())


def digits_of(text, base):
    value = 0
    for at, c in enumerate(text):
        digit = "0123456789abcdef".find(c.lower())
        if 0 <= digit < base:
            value = min(value * base + digit, (1 << 64) - 1)
        elif c != "_":
            return value, text[at:]
    return value, ""
