# SPDX-License-Identifier: Apache-2.0
"""Pointers and references: other names for variables, also for those of a FOR while it runs."""

import dataclasses

from kinds import Type
from tree import Expr, Stmt, indent
from units import Parameter

KINDS = ("REF_TO", "POINTER TO", "REFERENCE TO")
EXPORTED = ("POINTER TO",)  # those that PLCopen XML has
SCALARS = ("bool", "bits", "int", "real", "time", "date", "enum")


@dataclasses.dataclass
class Pointer:
    """Its value is the slot of what it leads to. A body sets it before everything else; one that keeps it from one
    scan to the next only if it leads nowhere."""
    name: str
    kind: str
    type: object  # of what it leads to
    targets: set = dataclasses.field(default_factory=set)  # names of all that it is set to

    def parameter(self):
        return Parameter(self.name, Type(f"{self.kind} {self.type.name}", "pointer"), "VAR")

    def place(self):
        name = self.name

        def run(f):
            container, key = f.values[name]
            return container[key]

        return Expr(name if self.kind == "REFERENCE TO" else f"{name}^", self.type, run, slot=lambda f: f.values[name])

    def bound_once(self, target):
        bound = self.bound(target)
        nowhere = f"NOT __ISVALIDREF({self.name})" if self.kind == "REFERENCE TO" else f"{self.name} = NULL"
        return Stmt([f"IF {nowhere} THEN", *indent(bound.lines), "END_IF;"],
                    lambda f: None if f.values[self.name] else bound.run(f))

    def bound(self, target):
        self.targets.add(target.text)
        word = {"REF_TO": f":= REF({target.text})", "POINTER TO": f":= ADR({target.text})"}.get(self.kind, f"REF= {target.text}")
        return Stmt([f"{self.name} {word};"], lambda f: f.values.__setitem__(self.name, target.slot(f)))


def targets(scope, type_=None):
    """Whole variables only: an element would be another one when its array is assigned to."""
    return [scope.read(one) for one in scope.places(True)
            if not one.edge and one.type.kind in SCALARS and type_ in (None, one.type)
            and (one.lasting or not scope.keeps_pointers)]


def make_pointers(rng, scope, kinds):
    """For some bodies: pointers in the scope, most of them to whole numbers, and the statements that set them."""
    found = targets(scope)
    if not found or rng.random() < 0.4:
        return []
    scope.keeps_pointers = scope.keeps_pointers and all(one.name.upper() != "NULL" for one in scope.variables)
    numbers = [one for one in found if one.type.kind == "int"]
    for i in range(rng.randint(1, 3)):
        target = rng.choice(numbers if numbers and rng.random() < 0.8 else found)
        scope.pointers.append(Pointer(f"pt{i}", rng.choice(kinds), target.type))
    return [(one.bound_once if scope.keeps_pointers else one.bound)(rng.choice(targets(scope, one.type)))
            for one in scope.pointers]


def rebind(rng, scope):
    """A statement that lets one of them lead elsewhere; None: there is none."""
    if not scope.pointers:
        return None
    pointer = rng.choice(scope.pointers)
    found = targets(scope, pointer.type)
    return pointer.bound(rng.choice(found)) if found else None
