# SPDX-License-Identifier: Apache-2.0
"""Random calls of the standard functions, by the kind of their result."""

import functions as do
import kinds
import tree
from conversions import convert
from kinds import BITS, BOOL, DATE, DT, INT, INTS, REALS, TIME, TOD, UNSIGNED, widen
from tree import Expr


def widened(expr, type_):
    source = expr.type.plain
    return expr.run if source is type_ or type_.kind != "real" else lambda f: widen(source, type_, expr.run(f))


def call(name, inputs):
    return f"{name}({', '.join(one.text for one in inputs)})"


def extreme(make, type_, depth):
    if type_.kind == "enum":
        return None
    name = make.rng.choice(("MAX", "MIN", "LIMIT"))
    inputs = make.several(type_, 3 if name == "LIMIT" else make.rng.randint(2, 4), depth)
    runs = [widened(one, type_) for one in inputs]
    function = {"MAX": do.maximum, "MIN": do.minimum, "LIMIT": do.limit}[name]
    return Expr(call(name, inputs), type_, lambda f: function(*[one(f) for one in runs]))


def moved(make, type_, depth):
    a = make.value(type_, depth)
    return None if a.bare else Expr(call("MOVE", [a]), type_, a.run)


def absolute(make, type_, depth):
    a = make.value(type_, depth)
    return None if a.bare else Expr(call("ABS", [a]), type_, lambda f: do.absolute(type_, a.run(f)))


def arithmetic(make, type_, depth):
    name, op = make.rng.choice((("ADD", "+"), ("MUL", "*"), ("SUB", "-")))
    inputs = make.several(type_, 2 if name == "SUB" else make.rng.randint(2, 4), depth)
    runs = [widened(one, type_) for one in inputs]

    def run(f):
        value = runs[0](f)
        for one in runs[1:]:
            value = do.arithmetic(op, type_, value, one(f))
        return value

    return Expr(call(name, inputs), type_, run)


def mathematics(make, type_, depth):
    name, c = make.rng.choice((("SQRT", "sqrt"), ("LN", "log"), ("LOG", "log10"), ("EXP", "exp"), ("SIN", "sin"), ("COS", "cos"),
                               ("TAN", "tan"), ("ASIN", "asin"), ("ACOS", "acos"), ("ATAN", "atan")))
    a = make.variable(type_)
    return a and Expr(call(name, [a]), type_, lambda f: do.of_libm(c, type_, a.run(f)))


def angle(make, type_, depth):
    y, x = make.variable(type_), make.variable(type_)
    return x and y and Expr(call("ATAN2", [y, x]), type_, lambda f: do.of_libm("atan2", type_, y.run(f), x.run(f)))


def truncation(make, type_, depth):
    source = make.rng.choice(REALS)
    a = make.value(source, depth)
    if a.bare:
        return None
    name = make.rng.choice((f"TRUNC_{type_.name}", f"{source.name}_TRUNC_{type_.name}"))
    return Expr(call(name, [a]), type_, lambda f: do.truncated(type_, a.run(f)))


def text_number(make, type_, depth):
    """LEN, FIND, STRING_TO_X."""
    a = make.text(depth)
    if type_ is not INT or make.rng.random() < 0.4:
        return Expr(call(f"STRING_TO_{type_.name}", [a]), type_, lambda f: convert(kinds.STRING, type_, a.run(f)))
    if make.rng.random() < 0.5:
        return Expr(call("LEN", [a]), INT, lambda f: len(a.run(f)))
    b = make.text(0)
    return Expr(call("FIND", [a, b]), INT, lambda f: do.find(a.run(f), b.run(f)))


def day_of_week(make, type_, depth):
    if type_ is not INT:
        return None
    a = make.value(DATE, depth)
    return Expr(call("DAY_OF_WEEK", [a]), INT, lambda f: do.calendar_rules.day_of_week(a.run(f)))


def decimals(make, type_, depth):
    if type_ not in UNSIGNED:
        return None
    bits = make.rng.choice(BITS)
    a = make.value(bits, depth)
    return None if a.bare else Expr(call(f"{bits.name}_BCD_TO_{type_.name}", [a]), type_,
                                    lambda f: do.from_bcd(type_, a.run(f), bits.bits))


def to_decimals(make, type_, depth):
    source = make.rng.choice(UNSIGNED)
    a = make.value(source, depth)
    return None if a.bare else Expr(call(f"{source.name}_TO_BCD_{type_.name}", [a]), type_,
                                    lambda f: do.to_bcd(a.run(f), type_.bits))


def shift(make, type_, depth):
    name = make.rng.choice(("SHL", "SHR", "ROL", "ROR"))
    a = make.value(type_, depth)
    number = make.rng.choice((0, 1, 3, 7, 8, 15, 16, 31, 40, 64, -1, -3))
    n = Expr(str(number), INT, lambda f: number) if make.rng.random() < 0.6 else make.value(make.rng.choice(INTS), 0)
    if a.bare:
        return None
    return Expr(call(name, [a, n]), type_, lambda f: do.shifted(name, type_, a.run(f), n.run(f)))


def bit_function(make, type_, depth):
    name = make.rng.choice(("AND", "OR", "XOR"))
    inputs = make.several(type_, make.rng.randint(2, 3), depth)

    def run(f):
        values = [one.run(f) for one in inputs]
        for one in values[1:]:
            values[0] = do.bitwise(name, type_, values[0], one)
        return values[0]

    return Expr(call(name, inputs), type_, run)


def compared(make, _type, depth):
    name, op = make.rng.choice((("GT", ">"), ("GE", ">="), ("EQ", "="), ("LE", "<="), ("LT", "<"), ("NE", "<>")))
    type_ = make.common_here([*INTS, *BITS, *REALS, TIME, DT, BOOL])
    inputs = make.several(type_, 2 if name == "NE" else make.rng.randint(2, 3), depth)
    runs = [widened(one, type_) for one in inputs]
    return Expr(call(name, inputs), BOOL, lambda f: do.chain(op, [one(f) for one in runs]))


def one_bit(make, _type, depth):
    found = make.paths(lambda t: t.kind in ("bits", "int"))
    if not found:
        return None
    a = make.rng.choice(found)
    number = make.rng.randrange(a.type.bits)
    shown = f"{a.text}.%X{number}" if make.rng.random() < 0.2 else f"{a.text}.{number}"
    return Expr(shown, BOOL, lambda f: bool(a.run(f) >> number & 1))


def part(make, type_, depth):
    """w.%B1"""
    found = make.paths(lambda t: t.kind == "bits" and t.low is None and t.bits > type_.bits)
    if not found or type_.bits > 32:
        return None
    a = make.rng.choice(found)
    number = make.rng.randrange(a.type.bits // type_.bits)
    mask = (1 << type_.bits) - 1
    return Expr(f"{a.text}.%{kinds.PART_LETTERS[type_.bits]}{number}", type_,
                lambda f: a.run(f) >> number * type_.bits & mask)


def valid(make, _type, depth):
    a = make.value(make.rng.choice(REALS), depth)
    return None if a.bare else Expr(call("IS_VALID", [a]), BOOL, lambda f: abs(a.run(f)) < float("inf"))


def now(make, type_, depth):
    return Expr("TIME()", TIME, lambda f: f.now)


def ticks(make, type_, depth):
    return Expr("T_PLC_MS()", type_, lambda f: f.now // 10**6 & 0xFFFFFFFF) if type_ is BITS[2] else None


def joined_date(make, type_, depth):
    a, b = make.value(DATE, depth), make.value(TOD, depth)
    return Expr(call("CONCAT_DATE_TOD", [a, b]), DT, lambda f: kinds.wrap(TIME, a.run(f) + b.run(f)))


def made_date(make, type_, depth):
    inputs = [make.value(INT, 0) for _ in range(3)]
    return Expr(call("CONCAT_DATE", inputs), DATE, lambda f: do.calendar_rules.date_of(*[one.run(f) for one in inputs]))


def text_part(make, _type, depth):
    name = make.rng.choice(("LEFT", "RIGHT", "MID", "DELETE"))
    a = make.text(depth)
    n, p = (make.value(make.rng.choice(INTS), 0) if make.rng.random() < 0.3 else small(make) for _ in "np")
    if name in ("LEFT", "RIGHT"):
        function = do.left if name == "LEFT" else do.right
        return Expr(call(name, [a, n]), kinds.STRING, lambda f: function(a.run(f), n.run(f)))
    function = do.mid if name == "MID" else do.delete
    return Expr(call(name, [a, n, p]), kinds.STRING, lambda f: function(a.run(f), n.run(f), p.run(f)))


def small(make):
    number = make.rng.randint(-1, 9)
    return Expr(str(number), INT, lambda f: number, tree.SIGN if number < 0 else tree.PRIMARY)


def text_joined(make, _type, depth):
    name = make.rng.choice(("CONCAT", "INSERT", "REPLACE"))
    a, b = make.text(depth), make.text(0)
    n, p = small(make), small(make)
    if name == "CONCAT":
        return Expr(call(name, [a, b]), kinds.STRING, lambda f: a.run(f) + b.run(f))
    if name == "INSERT":
        return Expr(call(name, [a, b, p]), kinds.STRING, lambda f: do.insert(a.run(f), b.run(f), p.run(f)))
    return Expr(call(name, [a, b, n, p]), kinds.STRING, lambda f: do.replace(a.run(f), b.run(f), n.run(f), p.run(f)))


def text_chosen(make, _type, depth):
    g, a, b = make.value(BOOL, depth), make.text(depth), make.text(0)
    return Expr(call("SEL", [g, a, b]), kinds.STRING, lambda f: do.selected(g.run(f), a.run(f), b.run(f)))


def text_of(make, _type, depth):
    source = make.rng.choice([BOOL, *BITS, *INTS, *REALS, TIME, DATE, TOD, DT])
    a = make.value(source, depth)
    if a.bare:
        return text_of(make, _type, depth)
    return Expr(call(f"{source.name}_TO_STRING", [a]), kinds.STRING, lambda f: convert(source, kinds.STRING, a.run(f)))


CALLS = {
    "int": [extreme, extreme, moved, absolute, arithmetic, truncation, text_number, day_of_week, decimals],
    "real": [extreme, extreme, moved, absolute, arithmetic, mathematics, angle],
    "bits": [extreme, part, shift, shift, bit_function, moved, to_decimals, ticks],
    "bool": [extreme, bit_function, compared, compared, one_bit, valid, moved],
    "time": [extreme, moved, now],
    "tod": [extreme, moved],
    "date": [extreme, made_date],
    "dt": [extreme, joined_date],
    "enum": [],
    "string": [text_part, text_joined, text_chosen, text_of],
}
