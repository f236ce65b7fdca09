# SPDX-License-Identifier: Apache-2.0
"""Functions and function blocks of a random program, and their calls."""

import dataclasses

import scope as parts
from kinds import BOOL, clone, zero
from tree import Expr, Frame, Return, Stmt, indent


START = 10**9  # when instances are started: the time of the first scan


@dataclasses.dataclass
class Parameter:
    name: str
    type: object
    section: str  # VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR VAR_TEMP
    initial: object = None  # Expr
    edge: str = ""  # R_EDGE, F_EDGE

    def first(self):
        return self.initial.run(None) if self.initial is not None else zero(self.type)

    def line(self):
        initial = f" := {self.initial.text}" if self.initial is not None else ""
        return f"{self.name} : {self.type.name}{' ' + self.edge if self.edge else ''}{initial};"

    def new(self):
        """Of an instance."""
        return self.type.new()


@dataclasses.dataclass
class Started(Parameter):
    """An instance whose FB_Init gets values."""
    given: list = dataclasses.field(default_factory=list)  # Expr
    by_position: int = 0  # so many of them; the others by name

    def line(self):
        names = [one.name for one in self.type.start.parameters]
        shown = [(f"{name} := " if i >= self.by_position else "") + expr.text
                 for i, (name, expr) in enumerate(zip(names, self.given))]
        return f"{self.name} : {self.type.name}({', '.join(shown)});"

    def new(self):
        made, start = self.type.new(), self.type.start
        inputs = {one.name: expr.run(None) for one, expr in zip(start.parameters, self.given)}
        inputs |= {"bInitRetains": False, "bInCopyCode": False}
        made.values |= inputs
        try:
            start.run_body(Frame(made.values, START))
        except Return:
            pass
        for name in inputs:
            del made.values[name]
        return made


@dataclasses.dataclass
class Start:
    """FB_Init of a function block: what runs before the first scan."""
    parameters: list
    lines: list
    run_body: object

    def text(self):
        return ["METHOD FB_Init : BOOL", "VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR", *declared(self.parameters),
                *indent(self.lines), "END_METHOD"]


def declared(parameters):
    """Parameters in their sections, in the order of the list as far as sections allow."""
    lines, section = [], ""
    for one in parameters:
        if one.section != section:
            lines += (["END_VAR"] if section else []) + [one.section]
            section = one.section
        lines.append("  " + one.line())
    return lines + (["END_VAR"] if section else [])


class Unit:
    """Of both: parameters and how actual values are passed."""

    def __init__(self, name, parameters):
        self.name = name
        self.parameters = parameters
        self.run_body = None
        self.lines = []

    def of(self, *sections):
        return [one for one in self.parameters if one.section in sections]

    def actuals(self, make, depth, taken):
        """One expression per input and in-out, and targets of some outputs; None if the scope has none that fit."""
        values, targets = [], []
        for one in self.of("VAR_INPUT", "VAR_IN_OUT"):
            if one.section == "VAR_INPUT":
                given = make.into(one.type, depth)
            else:
                found = [p for p in make.paths(lambda t: t is one.type, True, True) if root(p) not in taken]
                changed = [p for p in found if p.text in {place.text for place in make.changed}]
                given = make.rng.choice(changed or found) if found else None
            if given is None:
                return None
            if one.section == "VAR_IN_OUT":
                taken.add(root(given))
            values.append((one, given))
        for one in self.of("VAR_OUTPUT"):
            found = [p for p in make.paths(lambda t: t is one.type, True, True) if root(p) not in taken]
            if found and make.rng.random() < 0.6:
                target = make.rng.choice(found)
                taken.add(root(target))
                targets.append((one, target))
        return values, targets


def root(path):
    return path.text.split(".")[0].split("[")[0]


class Function(Unit):
    def __init__(self, name, parameters, result):
        super().__init__(name, parameters)
        self.result = result

    globals = ()  # what it declares as VAR_EXTERNAL

    @property
    def pure(self):
        return not self.of("VAR_IN_OUT", "VAR_OUTPUT") and not self.globals

    def text(self):
        head = f"FUNCTION {self.name} : {self.result.name}"
        return [head, *declared([*self.globals, *self.parameters]), *indent(self.lines), "END_FUNCTION"]

    def execute(self, now, inputs, refs):
        values = {one.name: one.first() for one in self.of("VAR", "VAR_TEMP", "VAR_OUTPUT")}
        values[self.name] = zero(self.result)
        frame = Frame(values | inputs, now, refs)
        try:
            self.run_body(frame)
        except Return:
            pass
        return frame.values

    def call(self, make, depth, taken=None):
        """As an expression; outputs are written before its value is used."""
        made = self.actuals(make, min(depth, 1), taken if taken is not None else set())
        if made is None:
            return None
        values, targets = made
        rng = make.rng
        formal = bool(targets) or rng.random() < 0.6
        given = [(one, expr) for one, expr in values if not (formal and one.section == "VAR_INPUT" and rng.random() < 0.15)]
        shuffled = formal and rng.random() < 0.3
        if shuffled:
            rng.shuffle(given)  # what stands on the left is computed first
        texts = [f"{one.name} := {expr.text}" if formal else expr.text for one, expr in given]
        texts += [f"{one.name} => {target.text}" for one, target in targets]
        if shuffled:
            texts = texts[len(given):] + texts[:len(given)]

        def run(f):
            inputs = {one.name: one.first() for one in self.of("VAR_INPUT")}
            refs = {}
            for one, expr in given:
                if one.section == "VAR_IN_OUT":
                    refs[one.name] = expr.slot(f)
                else:
                    inputs[one.name] = clone(expr.run(f))
            after = self.execute(f.now, inputs, refs)
            for one, target in targets:
                container, key = target.slot(f)
                container[key] = clone(after[one.name])
            return after[self.name]

        return Expr(f"{self.name}({', '.join(texts)})", self.result, run)


class Method(Function):
    """What it reads and writes is its own and that of its instance."""

    def text(self):
        head = f"METHOD PUBLIC {self.name} : {self.result.name}"
        return [head, *declared(self.parameters), *indent(self.lines), "END_METHOD"]

    def execute_in(self, instance, now, inputs):
        own = {one.name: one.first() for one in self.of("VAR")} | inputs | {self.name: zero(self.result)}
        instance.values |= own
        try:
            self.run_body(Frame(instance.values, now))
        except Return:
            pass
        return [instance.values.pop(name) for name in own][-1]

    def call_of(self, variable, make, depth, taken=None):
        made = self.actuals(make, min(depth, 1), taken if taken is not None else set())
        if made is None:
            return None
        given = made[0]

        def run(f):
            inputs = {one.name: clone(expr.run(f)) for one, expr in given}
            return self.execute_in(f.values[variable.name], f.now, inputs)

        return Expr(f"{variable.name}.{self.name}({', '.join(expr.text for _, expr in given)})", self.result, run)


class UserBlock(Unit):
    """A FUNCTION_BLOCK; `new()` makes an instance."""

    start = None  # FB_Init
    methods = ()
    globals = ()

    def text(self):
        start = self.start.text() if self.start else []
        start += [line for one in self.methods for line in one.text()]
        return [f"FUNCTION_BLOCK {self.name}", *declared([*self.parameters, *self.globals]), *start, *indent(self.lines), "END_FUNCTION_BLOCK"]

    def new(self):
        return Instance(self)

    def readable(self, base):
        return [parts.member(Expr(base.text, None, lambda f: base.run(f).values), one.name, one.type)
                for one in self.of("VAR_OUTPUT")]

    def call(self, make, variable, depth):
        made = self.actuals(make, depth, {variable.name})
        if made is None:
            return None
        values, targets = made
        return block_call(make, variable, [(o.name, o.section, e) for o, e in values], [(o.name, t) for o, t in targets])


class Instance:
    def __init__(self, unit):
        self.unit = unit
        self.values = {one.name: one.first() for one in unit.of("VAR_INPUT", "VAR_OUTPUT", "VAR")}
        self.values |= {one.name: one.new() for one in unit.of("VAR_BLOCK")}
        self.before = {one.name: one.edge == "F_EDGE" for one in unit.parameters if one.edge}

    def call(self, now, refs):
        edges = {}
        for one in self.unit.parameters:
            if one.edge:
                now_on, was_on = self.values[one.name], self.before[one.name]
                edges[one.name] = (now_on and not was_on) if one.edge == "R_EDGE" else (was_on and not now_on)
                self.before[one.name] = now_on
        for one in self.unit.of("VAR_TEMP"):
            self.values[one.name] = one.first()
        try:
            self.unit.run_body(Frame(self.values, now, refs, edges))
        except Return:
            pass


class LibraryBlock:
    """An instance's type of the library."""

    def __init__(self, made):
        self.made = made
        self.name = made.name

    def new(self):
        return self.made()

    def readable(self, base):
        return [parts.member(Expr(base.text, None, lambda f: base.run(f).values), name, type_)
                for name, type_ in self.made.outputs]

    def call(self, make, variable, depth):
        values, targets, taken = [], [], {variable.name}
        for name, type_ in self.made.inputs:
            if make.rng.random() < 0.85:
                values.append((name, "VAR_INPUT", make.into(type_, depth)))
        for name, type_ in self.made.outputs:
            found = [p for p in make.paths(lambda t: t is type_, True, True) if root(p) not in taken]
            if found and make.rng.random() < 0.4:
                target = make.rng.choice(found)
                taken.add(root(target))
                targets.append((name, target))
        return block_call(make, variable, values, targets)


def block_call(make, variable, values, targets):
    rng = make.rng
    given = [one for one in values if one[1] == "VAR_IN_OUT" or rng.random() < 0.85]
    texts = [f"{name} := {expr.text}" for name, _, expr in given]
    negated = {name for name, target in targets if target.type is BOOL and rng.random() < 0.15}
    texts += [f"{'NOT ' if name in negated else ''}{name} => {target.text}" for name, target in targets]
    enable = make.value(BOOL, 1) if rng.random() < 0.1 else None
    enabled_to = None
    if enable is not None:
        texts.insert(0, f"EN := {enable.text}")
        taken = {root(target) for _, target in targets} | {root(e) for _, s, e in given if s == "VAR_IN_OUT"}
        found = [p for p in make.paths(lambda t: t is BOOL, True, True) if root(p) not in taken]
        if found:
            enabled_to = rng.choice(found)
            texts.append(f"ENO => {enabled_to.text}")

    def run(f):
        on = enable is None or enable.run(f)
        if on:
            evaluate(f)
        if enabled_to is not None:
            container, key = enabled_to.slot(f)
            container[key] = on

    def evaluate(f):
        instance, refs = f.values[variable.name], {}
        for name, section, expr in given:
            if section == "VAR_IN_OUT":
                refs[name] = expr.slot(f)
            else:
                instance.values[name] = clone(expr.run(f))
        if isinstance(instance, Instance):
            instance.call(f.now, refs)
        else:
            instance.call(f.now)
        for name, target in targets:
            value = instance.values[name]
            container, key = target.slot(f)
            container[key] = (not value) if name in negated else clone(value)

    return Stmt([f"{variable.name}({', '.join(texts)});"], run)
