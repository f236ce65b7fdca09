# SPDX-License-Identifier: Apache-2.0
"""What a body can name: variables, the parts of them, functions and instances."""

import dataclasses

from tree import Expr, Fault


@dataclasses.dataclass
class Variable:
    name: str
    type: object  # null: an instance
    writable: bool = True
    edge: bool = False  # an input of which only the edge counts
    instance: object = None  # Block
    store: dict = None  # a global: where the values of all globals are
    lasting: bool = True  # no VAR_TEMP, no VAR_IN_OUT


class Scope:
    def __init__(self, variables, functions=(), blocks=()):
        self.variables = variables
        self.functions = list(functions)
        self.changing = []  # order.Changer
        self.pointers = []  # aliases.Pointer
        self.keeps_pointers = False  # from one scan to the next
        self.locked = set()  # variables of the FORs around
        self.ranges = {}  # variable of a FOR: its values

    def types(self):
        """The elementary ones of variables and of the parts of them."""
        found, left = set(), [one.type for one in self.variables if one.type is not None]
        while left:
            one = left.pop()
            left += [one.element] if one.kind == "array" else [of for _, of in one.fields]
            found.add(one.plain)
        return found

    def changers(self):
        """What is called in expressions and changes more than its result: functions, methods of instances."""
        methods = [BoundMethod(one, method) for one in self.instances() for method in getattr(one.instance, "methods", ())]
        return [one for one in self.functions if not one.pure] + methods

    def instances(self):
        return [one for one in self.variables if one.instance is not None]

    def read(self, variable):
        """The variable as an expression."""
        name = variable.name
        if variable.edge:
            return Expr(name, variable.type, lambda f: f.edges[name])

        def slot(f):
            return f.slot(name, variable.store)

        def run(f):
            container, key = slot(f)
            return container[key]

        return Expr(name, variable.type, run, slot=slot)

    def places(self, writable):
        """Variables of all types that can be read, or written."""
        return [one for one in self.variables
                if one.instance is None and (not writable or (one.writable and one.name not in self.locked))]


@dataclasses.dataclass
class BoundMethod:
    """A method of an instance in scope, called like a function."""
    variable: Variable
    method: object

    @property
    def result(self):
        return self.method.result

    def call(self, make, depth, taken=None):
        return self.method.call_of(self.variable, make, depth, taken)


def member(base, name, type_):
    def slot(f):
        return base.run(f), name

    return Expr(f"{base.text}.{name}", type_, lambda f: base.run(f)[name], slot=slot)


def element(base, type_, indices):
    """base[i, j]"""
    bounds = base.type.bounds

    def slot(f):
        numbers = [one.run(f) for one in indices]
        at = base.run(f)
        for number, (low, high) in zip(numbers, bounds):
            if not low <= number <= high:
                raise Fault("index")
        for number, (low, _) in zip(numbers[:-1], bounds):
            at = at[number - low]
        return at, numbers[-1] - bounds[-1][0]

    def run(f):
        container, key = slot(f)
        return container[key]

    return Expr(f"{base.text}[{', '.join(one.text for one in indices)}]", type_, run, slot=slot)
