# SPDX-License-Identifier: Apache-2.0
"""A piece of a program twice: its text, and a Python function that does what the standard says the text does.

The functions take a Frame, the variables of one call. Nothing here knows how the compiler works."""

import dataclasses

# Precedence, weakest first.
OR, XOR, AND, EQUAL, ORDERED, SUM, PRODUCT, POWER, SIGN, PRIMARY = range(1, 11)


class Fault(Exception):
    """What ends a scan: division by zero, an index outside of its bounds, ..."""


class Exit(Exception):
    pass


class Continue(Exception):
    pass


class Return(Exception):
    pass


class Jump(Exception):
    pass


class Endless(Exception):
    """What is reached by another name than that of the loop's variable keeps the loop from ending."""


class Rounds:
    """Of one loop."""

    def __init__(self):
        self.left = 200

    def take(self):
        self.left -= 1
        if self.left < 0:
            raise Endless


class Frame:
    def __init__(self, values, now, refs=None, edges=None):
        self.values = values  # by name
        self.refs = refs or {}  # VAR_IN_OUT: (container, key)
        self.edges = edges or {}  # inputs of which only the edge counts
        self.now = now

    def slot(self, name, store=None):
        """`store`: where the values of globals are, if it is one."""
        return self.refs[name] if name in self.refs else (self.values if store is None else store, name)


@dataclasses.dataclass
class Expr:
    text: str
    type: object
    run: object  # frame -> value
    level: int = PRIMARY
    slot: object = None  # frame -> (container, key), of what can be assigned
    bare: bool = False  # a number without a type

    def at(self, level, rng=None):
        """The text as an operand of an operator that binds so strongly."""
        loose = self.level < level or (rng is not None and rng.random() < 0.1)
        return f"({self.text})" if loose else self.text


# How often each statement ran; in the text it is marked by its number.
counts = []


@dataclasses.dataclass
class Stmt:
    lines: list
    run: object  # frame -> None
    label: str = ""

    def __post_init__(self):
        if self.label:
            return
        number, run = len(counts), self.run
        counts.append(0)

        def counted(frame):
            counts[number] += 1
            run(frame)

        self.lines = [f"{self.lines[0]} (*#{number}*)", *self.lines[1:]]
        self.run = counted


def indent(lines):
    return ["  " + line for line in lines]


def sequence(statements):
    """One after the other. A jump goes forward to a label of the same list."""
    labels = {one.label: i for i, one in enumerate(statements) if one.label}

    def run(frame):
        at = 0
        while at < len(statements):
            try:
                statements[at].run(frame)
                at += 1
            except Jump as jump:
                if jump.args[0] not in labels:
                    raise
                at = labels[jump.args[0]]

    return run


def text_of(statements):
    return [line for one in statements for line in one.lines]
