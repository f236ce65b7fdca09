# SPDX-License-Identifier: Apache-2.0
"""Statements whose value shows in which order their parts were computed: a place, and calls that change it."""

import dataclasses

import functions as do
import scope as parts
import tree
from kinds import BOOL, INT, TIME, clone, wrap
from tree import Expr, Stmt
from units import Function, Parameter


@dataclasses.dataclass
class Changer:
    """A function that changes a variable of the type, its VAR_IN_OUT or a global, and returns what it was or is."""
    function: Function
    type: object
    place: str  # the global; "": what is given to it


def changed(type_, value, by):
    if type_ is BOOL:
        return not value
    return do.bitwise("XOR", type_, do.shifted("ROL", type_, value, 1), by) if type_.kind == "bits" else wrap(type_, value + by)


def make_changer(rng, name, type_, of_all):
    """`of_all`: a global of this type; null: with a VAR_IN_OUT."""
    by = rng.choice((1, 3, 7, 11, 101))
    place = of_all.name if of_all else "v"
    by_text = f"T#{by}ms" if type_ is TIME else str(by)
    by = by * 10**6 if type_ is TIME else by
    text = {"bool": f"NOT {place}", "bits": f"ROL({place}, 1) XOR {by_text}"}.get(type_.kind, f"{place} + {by_text}")
    before = rng.random() < 0.5
    made = Function(name, [] if of_all else [Parameter("v", type_, "VAR_IN_OUT")], type_)
    made.globals = [Parameter(of_all.name, type_, "VAR_EXTERNAL")] if of_all else []
    variable = parts.Scope([]).read(of_all or parts.Variable(place, type_))
    lines = [f"{place} := {text};", f"{name} := {place};"]

    def run(f):
        container, key = variable.slot(f)
        old = container[key]
        container[key] = changed(type_, old, by)
        f.values[name] = old if before else container[key]

    made.lines = [lines[1], lines[0]] if before else lines
    made.run_body = run
    return Changer(made, type_, of_all.name if of_all else "")


def make_mix(name, type_):
    """Of two inputs, which it treats differently."""
    made = Function(name, [Parameter(one, type_, "VAR_INPUT") for one in ("a", "b")], type_)
    text, run = mixture(type_, "a", "b")
    made.lines = [f"{name} := {text};"]
    made.run_body = lambda f: f.values.__setitem__(name, run(f.values["a"], f.values["b"]))
    return made


def mixture(type_, a, b):
    if type_ is BOOL:
        return f"{a} AND NOT {b}", lambda x, y: x and not y
    if type_.kind == "bits":
        return f"ROL({a}, 3) XOR {b}", lambda x, y: do.bitwise("XOR", type_, do.shifted("ROL", type_, x, 3), y)
    return f"{a} + {a} - {b}", lambda x, y: wrap(type_, x + x - y)


class Witness:
    """Makes such statements for a Writer."""

    def __init__(self, writer):
        self.rng, self.make, self.scope = writer.rng, writer.make, writer.scope

    def statement(self):
        """None: nothing here can be changed."""
        rng = self.rng
        for changer in rng.sample(self.scope.changing, len(self.scope.changing)):
            places = self.places(changer)
            targets = [one for one in self.make.paths(lambda t: t is changer.type, True, True)]
            if places and targets:
                break
        else:
            return None
        self.changer, self.type, self.place = changer, changer.type, rng.choice(places)
        value = self.tree(rng.randint(1, 3))
        target = rng.choice(targets)
        if rng.random() < 0.3:
            condition = self.compared()
            return Stmt([f"IF {condition.text} THEN {target.text} := {value.text}; END_IF;"],
                        lambda f: self.store(target, value.run(f), f) if condition.run(f) else None)
        return Stmt([f"{target.text} := {value.text};"], lambda f: self.store(target, value.run(f), f))

    @staticmethod
    def store(target, value, f):
        container, key = target.slot(f)
        container[key] = clone(value)

    def places(self, changer):
        found = self.make.paths(lambda t: t is changer.type, True, True)
        if changer.place:
            return [one for one in found if one.text == changer.place]
        return found

    def leaf(self):
        function = self.changer.function
        if self.rng.random() < 0.5:
            return self.place
        given = [] if self.changer.place else [self.place]
        text = ", ".join(("v := " if self.rng.random() < 0.5 else "") + one.text for one in given)
        slot = self.place.slot
        run = lambda f: function.execute(f.now, {}, {"v": slot(f)} if given else {})[function.name]
        return Expr(f"{function.name}({text})", self.type, run)

    def tree(self, depth):
        if depth == 0:
            return self.leaf()
        a, b = self.tree(depth - 1), self.tree(self.rng.randint(0, depth - 1))
        return self.rng.choice((self.operation, self.operation, self.mixed, self.chosen, self.several))(a, b)

    def operation(self, a, b):
        type_ = self.type
        if type_ is BOOL or type_.kind == "bits":
            op = self.rng.choice(("XOR", "AND", "OR"))
            level = {"AND": tree.AND, "OR": tree.OR, "XOR": tree.XOR}[op]
            run = lambda f: do.bitwise(op, type_, a.run(f), b.run(f))
            if type_ is BOOL and op != "XOR":
                run = (lambda f: a.run(f) and b.run(f)) if op == "AND" else (lambda f: a.run(f) or b.run(f))
            return self.make.infix(op, level, a, b, type_, run)
        op = self.rng.choice("+-" if type_ is TIME else "+-*")
        level = tree.PRODUCT if op == "*" else tree.SUM
        return self.make.infix(op, level, a, b, type_, lambda f: do.arithmetic(op, type_, a.run(f), b.run(f)))

    def mixed(self, a, b):
        mixes = [one for one in self.scope.functions if one.result is self.type and [p.name for p in one.parameters] == ["a", "b"]]
        if not mixes:
            return self.operation(a, b)
        mix = self.rng.choice(mixes)
        text = self.rng.choice((f"{a.text}, {b.text}", f"a := {a.text}, b := {b.text}"))
        return Expr(f"{mix.name}({text})", self.type,
                    lambda f: mix.execute(f.now, {"a": a.run(f), "b": b.run(f)}, {})[mix.name])

    def chosen(self, a, b):
        condition = self.compared()
        return Expr(f"SEL({condition.text}, {a.text}, {b.text})", self.type,
                    lambda f: do.selected(condition.run(f), a.run(f), b.run(f)))

    def several(self, a, b):
        c, name = self.leaf(), self.rng.choice(("MAX", "MIN", "MUX"))
        if name == "MUX":
            k = self.rng.randint(0, 2)
            return Expr(f"MUX(INT#{k}, {a.text}, {b.text}, {c.text})", self.type, lambda f: do.mux(k, a.run(f), b.run(f), c.run(f)))
        function = do.maximum if name == "MAX" else do.minimum
        return Expr(f"{name}({a.text}, {b.text}, {c.text})", self.type, lambda f: function(a.run(f), b.run(f), c.run(f)))

    def compared(self):
        a, b = self.leaf(), self.leaf()
        op = self.rng.choice(("=", "<>", "<", ">"))
        level = tree.EQUAL if op in ("=", "<>") else tree.ORDERED
        made = self.make.infix(op, level, a, b, BOOL, lambda f: do.COMPARE[op](a.run(f), b.run(f)))
        return Expr(f"({made.text})", BOOL, made.run)
