# SPDX-License-Identifier: Apache-2.0
"""Expressions in which no number has a type: MAX(300, 1) * 300. They take the type of the other operand, and the widest
where nothing does; so none of their steps may leave it, and then they are what mathematics says."""

import dataclasses

import functions as do
import tree
from conversions import convert
from kinds import BITS, BOOL, INTS, REALS, STRING, real_of
from tree import Expr

LINT, LREAL = INTS[3], REALS[1]


@dataclasses.dataclass
class Bare:
    expr: Expr
    low: object
    high: object
    called: bool = False  # a function is in it: the compiler does not know its value


class Writer:
    def __init__(self, make, low, high, halves, divides):
        self.make = make
        self.rng = make.rng
        self.low, self.high = low, high
        self.halves = halves  # 2.5
        self.divides = divides

    def literal(self):
        rng = self.rng
        most = min(rng.choice((5, 40, 300, 807)), self.high)
        value = rng.randint(max(-most, self.low), most)
        if self.halves and rng.random() < 0.3:
            value = abs(value) / 2 if value % 2 else abs(value) + 0.5
            return Bare(Expr(str(value), None, lambda f: value), value, value)
        if value < 0:
            return Bare(Expr(str(value), None, lambda f: value, tree.SIGN), value, value)
        return Bare(Expr(str(value), None, lambda f: value), value, value)

    def made(self, depth):
        """One whose steps all stay within the limits."""
        while True:
            one = self.literal() if depth <= 0 or self.rng.random() < 0.2 else self.step(depth)
            if one is not None and self.low <= one.low and one.high <= self.high:
                return one

    def step(self, depth):
        return self.rng.choice((self.infix, self.infix, self.extreme, self.extreme, self.selection, self.function))(depth)

    def combined(self, op, a, b):
        corners = [{"+": x + y, "-": x - y, "*": x * y}[op] for x in (a.low, a.high) for y in (b.low, b.high)]
        run = {"+": lambda f: a.expr.run(f) + b.expr.run(f), "-": lambda f: a.expr.run(f) - b.expr.run(f),
               "*": lambda f: a.expr.run(f) * b.expr.run(f)}[op]
        return run, min(corners), max(corners)

    def infix(self, depth):
        a, b, op = self.made(depth - 1), self.made(depth - 1), self.rng.choice(["+", "-", "*"] + ["/", "MOD"] * self.divides)
        if op in ("/", "MOD"):
            return self.division(op, a)
        run, low, high = self.combined(op, a, b)
        level = tree.PRODUCT if op == "*" else tree.SUM
        text = f"{a.expr.at(level, self.rng)} {op} {b.expr.at(level + 1, self.rng)}"
        return Bare(Expr(text, None, run, level), low, high, a.called or b.called)

    def division(self, op, a):
        number = self.rng.choice((2, 3, 7, 10))
        whole = lambda value: abs(value) // number * (1 if value >= 0 else -1)
        rest = lambda value: value - number * whole(value)
        run = (lambda f: whole(a.expr.run(f))) if op == "/" else (lambda f: rest(a.expr.run(f)))
        text = f"{a.expr.at(tree.PRODUCT, self.rng)} {op} {number}"
        most = max(abs(a.low), abs(a.high))
        return Bare(Expr(text, None, run, tree.PRODUCT), -most if a.low < 0 else 0, most, a.called)

    def function(self, depth):
        """ADD(1, 2) and so on are what the operators are."""
        name, op = self.rng.choice((("ADD", "+"), ("SUB", "-"), ("MUL", "*"), ("ABS", ""), ("MOVE", "")))
        a = self.made(depth - 1)
        if name == "MOVE":
            return Bare(Expr(f"MOVE({a.expr.text})", None, a.expr.run), a.low, a.high, True)
        if name == "ABS":
            return Bare(Expr(f"ABS({a.expr.text})", None, lambda f: abs(a.expr.run(f))), 0, max(abs(a.low), abs(a.high)), True)
        b = self.made(depth - 1)
        run, low, high = self.combined(op, a, b)
        return Bare(Expr(f"{name}({a.expr.text}, {b.expr.text})", None, run), low, high, True)

    def extreme(self, depth):
        name = self.rng.choice(("MAX", "MIN", "LIMIT"))
        inputs = [self.made(depth - 1) for _ in range(3 if name == "LIMIT" else self.rng.randint(2, 3))]
        function = {"MAX": do.maximum, "MIN": do.minimum, "LIMIT": do.limit}[name]
        return self.one_of(f"{name}(", inputs, lambda f: function(*[one.expr.run(f) for one in inputs]))

    def selection(self, depth):
        inputs = [self.made(depth - 1) for _ in range(2)]
        if self.rng.random() < 0.5:
            k = self.rng.randint(0, 1)
            # All inputs are evaluated: what is not chosen may have calls that change variables.
            return self.one_of(f"MUX({k}, ", inputs, lambda f: [one.expr.run(f) for one in inputs][k])
        g = self.make.value(BOOL, 0)
        return self.one_of(f"SEL({g.text}, ", inputs,
                           lambda f: do.selected(g.run(f), inputs[0].expr.run(f), inputs[1].expr.run(f)))

    @staticmethod
    def one_of(head, inputs, run):
        text = head + ", ".join(one.expr.text for one in inputs) + ")"
        return Bare(Expr(text, None, run), min(one.low for one in inputs), max(one.high for one in inputs), True)


def written(make, low, high, halves=False, divides=False):
    writer = Writer(make, low, high, halves, divides)
    while True:
        one = writer.made(make.rng.randint(1, 3))
        if one.called:
            return one.expr


def typed_by_operand(make, type_):
    """One that takes the type."""
    if type_.kind == "real":  # few enough digits for a REAL
        halves = make.rng.random() < 0.5
        most = 1 << (12 if halves else 20)
        one = written(make, -most, most, halves)
        return Expr(one.text, type_, lambda f: real_of(type_, one.run(f)), one.level, bare=True)
    one = written(make, type_.least(), type_.greatest(), divides=True)
    return Expr(one.text, type_, one.run, one.level, bare=True)


def alone(make, halves=False):
    """One that nothing gives a type."""
    most = 1 << (40 if halves else 60)
    return written(make, -most, most, halves, divides=not halves)


def compared(make, _type, depth):
    """Two of them: MAX(300, 1) * 300 > 30000."""
    halves = make.rng.random() < 0.3
    a = alone(make, halves)
    b = alone(make, halves) if make.rng.random() < 0.5 else Writer(make, -(1 << 40), 1 << 40, halves, False).literal().expr
    if make.rng.random() < 0.3:
        a, b = b, a
    op, name = make.rng.choice((("=", "EQ"), ("<>", "NE"), ("<", "LT"), (">", "GT"), ("<=", "LE"), (">=", "GE")))
    run = lambda f: do.COMPARE[op](a.run(f), b.run(f))
    if make.rng.random() < 0.3:
        return Expr(f"{name}({a.text}, {b.text})", BOOL, run)
    level = tree.EQUAL if op in ("=", "<>") else tree.ORDERED
    return Expr(f"{a.at(level)} {op} {b.at(level + 1)}", BOOL, run, level)


def converted(make, type_, depth):
    """TO_DINT(MAX(300, 1) * 300)"""
    if type_ not in (*INTS, *BITS, *REALS, STRING):
        return None
    one = alone(make)
    return Expr(f"TO_{type_.name}({one.text})", type_, lambda f: convert(LINT, type_, one.run(f)))
