# SPDX-License-Identifier: Apache-2.0
"""Random expressions of a type that is wanted. Every operand has the type of the operation, a narrower one, or is a bare
number that takes it."""

import re

import bare_numbers
import functions as do
import literals
import scope as parts
import tree
from conversions import convert
from kinds import BITS, BOOL, DATE, DT, INT, INTS, REAL, REALS, TIME, TOD, UNSIGNED, common, real_of, string, widens, wrap
from library_calls import CALLS, widened
from tree import Expr


def known_zero(expr):
    """Whether the value needs no variables and is 0, or cannot be known."""
    try:
        return expr.run(None) == 0
    except AttributeError:
        return bool(re.search(r"\bk\d", expr.text))
    except tree.Fault:
        return True


SHORT_TEXT = string(20)


class Maker:
    def __init__(self, rng, scope):
        self.rng = rng
        self.scope = scope
        self.changer = None  # the function that this statement calls in addition to its change
        self.changed = []  # the places it changes
        self.narrower = False  # what is made becomes a wider type

    # Calls in addition to the change: they show in which order operands are computed

    def begin(self):
        """Of a statement. Its expressions may name one place and call what changes it."""
        self.changer, self.changed = None, []
        known = self.scope.changers()
        if not known or self.rng.random() < 0.3:
            return
        self.changer = self.rng.choice(known)
        if isinstance(self.changer, parts.BoundMethod):
            instance = self.scope.read(self.changer.variable)
            self.changed = self.changer.variable.instance.readable(instance)
        else:
            for one in self.changer.of("VAR_IN_OUT"):
                found = self.paths(lambda t: t is one.type, True, True)
                self.changed += [self.rng.choice(found)] if found else []
            self.changed += [self.scope.read(one) for one in self.scope.places(False) if one.store is not None]

    def changing_call(self, type_, depth):
        """The call, converted to the type if need be."""
        source = self.changer.result
        if source is not type_ and source not in self.convertible(type_):
            return None
        made = self.changer.call(self, depth)
        if made is None or source is type_:
            return made
        return Expr(f"{source.name}_TO_{type_.name}({made.text})", type_, lambda f: convert(source, type_, made.run(f)))

    # Places

    def paths(self, wanted, writable=False, constant_index=False):
        """Everything in scope whose type is accepted, as far as a few steps lead."""
        found = []
        for variable in self.scope.places(writable):
            self.walk(self.scope.read(variable), wanted, constant_index, found, 0)
        found += [one.place() for one in self.scope.pointers if wanted(one.type)]
        if not writable:
            for variable in self.scope.instances():
                found += [one for one in variable.instance.readable(self.scope.read(variable)) if wanted(one.type)]
        return found

    def walk(self, base, wanted, constant_index, found, depth):
        if wanted(base.type):
            found.append(base)
        if depth > 3:
            return
        if base.type.kind == "struct":
            for name, type_ in base.type.fields:
                self.walk(parts.member(base, name, type_), wanted, constant_index, found, depth + 1)
        elif base.type.kind == "array":
            indices = [self.index(bounds, constant_index) for bounds in base.type.bounds]
            self.walk(parts.element(base, base.type.element, indices), wanted, constant_index, found, depth + 1)

    def index(self, bounds, constant):
        low, high = bounds
        number = self.rng.randint(low, high)
        fixed = Expr(str(number), INT, lambda f: number)
        loops = [name for name, (a, b) in self.scope.ranges.items() if a >= low and b <= high]
        choice = self.rng.random()
        if constant or choice < 0.5:
            return fixed
        if loops and choice < 0.8:
            loop = self.rng.choice(loops)
            return self.scope.read(next(one for one in self.scope.variables if one.name == loop))
        plain = [self.scope.read(one) for one in self.scope.places(False)] + [one.place() for one in self.scope.pointers]
        plain = [one for one in plain if one.type.kind == "int" and one.type.bits < 64]
        if not plain:
            return fixed
        variable = self.rng.choice(plain)
        if choice > 0.97 and not variable.text.startswith("k"):
            return variable  # a fault, most likely; of a constant it would be refused
        run = variable.run
        return Expr(f"LIMIT({low}, {variable.text}, {high})", variable.type,
                    lambda f: do.limit(low, run(f), high)) if variable.type.signed or low >= 0 else fixed

    def variable(self, type_):
        fits = lambda t: t.plain is type_ or (t.kind == type_.kind == "string")
        changed = [one for one in self.changed if fits(one.type)]
        if changed and self.rng.random() < 0.6:
            return self.rng.choice(changed)
        found = self.paths(fits)
        led_to = [one.place() for one in self.scope.pointers if fits(one.type)]
        if led_to and self.rng.random() < 0.3:
            return self.rng.choice(led_to)
        return self.rng.choice(found) if found else None

    def common_here(self, types):
        """One of them; rather one that variables have."""
        here = [one for one in types if one in self.scope.types()]
        return self.rng.choice(here if here and self.rng.random() < 0.7 else types)

    # Values

    def value(self, type_, depth=3):
        """An expression of exactly this elementary type, or of this enumeration."""
        rng = self.rng
        if type_.kind == "string":
            return self.text(depth)
        choice = rng.random()
        if self.changer is not None and choice < 0.15:
            made = self.changing_call(type_, depth)
            if made is not None:
                return made
        if depth <= 0 or choice < 0.25:
            found = self.variable(type_) if rng.random() < 0.75 else None
            return found or literals.of_value(rng, type_, literals.some_value(rng, type_))
        options = [self.selection, *CALLS.get(type_.kind, [])]
        if type_.kind in ("int", "real"):
            options = [self.arithmetic] * 4 + [self.sign] + options + [self.conversion] * 2
        elif type_.kind == "bool":
            options = [self.comparison] * 4 + [self.logic] * 4 + [self.negation] + options + [self.conversion]
        elif type_.kind == "bits":
            options = [self.logic] * 3 + [self.negation] + options + [self.conversion]
        elif type_.kind != "enum":
            options = [self.times] * 4 + options + [self.conversion]
        if any(one.result is type_ for one in self.callable()):
            options = options + [self.user_call] * 2
        if rng.random() < 0.2:
            options = options + [bare_numbers.compared if type_.kind == "bool" else bare_numbers.converted]
        made = None
        while made is None:
            one = rng.choice(options)
            made = one(type_, depth - 1) if hasattr(one, "__self__") else one(self, type_, depth - 1)
        return made

    def operand(self, type_, depth, bare=False):
        """Of the type, narrower, or a bare number."""
        rng = self.rng
        if bare and not self.narrower and type_.kind in ("int", "real") and rng.random() < 0.1:
            return bare_numbers.typed_by_operand(self, type_)
        if bare and type_.kind in ("int", "real", "bits") and rng.random() < 0.4:
            value = literals.some_value(rng, type_)
            if type_.kind == "real" and value == int(value) and abs(value) < 1 << 20 and rng.random() < 0.3:
                whole = int(value)
                return Expr(str(whole), type_, lambda f: real_of(type_, whole), tree.SIGN if whole < 0 else tree.PRIMARY, bare=True)
            return literals.of_value(rng, type_, value, typed=False)
        if rng.random() < 0.2:
            narrower = [one for one in (*INTS, *BITS, REAL) if one is not type_ and widens(one, type_)]
            if narrower:
                one = rng.choice(narrower)
                # A bare number in it would take the wider type, which is wanted; those are for operands of that type.
                outer, self.narrower = self.narrower, True
                made = self.value(one, min(depth, 1))
                self.narrower = outer
                return made if not made.bare else None
        return self.value(type_, depth)

    def pair(self, type_, depth):
        """Two operands whose common type is the wanted one; at most one of them is bare."""
        for _ in range(20):
            a, b = self.operand(type_, depth), self.operand(type_, depth, bare=True)
            if a is None or b is None or a.bare or (not b.bare and common(a.type.plain, b.type.plain) is not type_):
                continue
            if b.bare and a.type.plain is not type_:
                continue
            return (b, a) if self.rng.random() < 0.3 else (a, b)
        return None

    def several(self, type_, count, depth):
        """Operands of one type; the last ones may be bare."""
        out = [self.value(type_, depth)]
        while len(out) < count:
            one = self.operand(type_, depth, bare=True) if self.rng.random() < 0.5 else self.value(type_, depth)
            if one is not None and (one.bare or one.type.plain is type_):
                out.append(one)
        return out

    def infix(self, op, level, a, b, type_, run):
        text = f"{a.at(level, self.rng)} {op} {b.at(level + 1, self.rng)}"
        return Expr(text, type_, run, level)

    def arithmetic(self, type_, depth):
        rng = self.rng
        op = rng.choice(["+", "-", "*", "+", "-", "*", "/"] + (["MOD"] if type_.kind == "int" else []))
        if type_.kind == "real" and rng.random() < 0.08:
            return self.power(type_, depth)
        both = self.pair(type_, depth)
        if both is None:
            return None
        a, b = both
        if op in ("/", "MOD") and rng.random() < 0.95:
            number = rng.choice((1, 2, 3, 7, 10, 100))
            divisor = real_of(type_, number) if type_.kind == "real" else number
            b = literals.of_value(rng, type_, divisor, typed=a.bare or rng.random() < 0.5)
            if a.type.plain is not type_ and b.bare:
                return None
        if op in ("/", "MOD") and known_zero(b):
            return None  # an error of the program
        x, y = widened(a, type_), widened(b, type_)
        level = tree.SUM if op in "+-" else tree.PRODUCT
        return self.infix(op, level, a, b, type_, lambda f: do.arithmetic(op, type_, x(f), y(f)))

    def power(self, type_, depth):
        base = self.value(type_, depth)
        number = self.rng.choice((0, 1, 2, 3, -1))
        exponent = literals.of_value(self.rng, INT, number, typed=True) if self.rng.random() < 0.5 else self.value(type_, 0)
        if base.bare or exponent.bare:
            return None
        text = f"{base.at(tree.POWER)} ** {exponent.at(tree.SIGN)}"
        return Expr(text, type_, lambda f: do.power(type_, base.run(f), exponent.run(f)), tree.POWER)

    def sign(self, type_, depth):
        a = self.value(type_, depth)
        if a.bare or (type_.kind == "int" and not type_.signed):
            return None
        return Expr(f"-{a.at(tree.PRIMARY, self.rng)}", type_, lambda f: do.negated(type_, a.run(f)), tree.SIGN)

    @staticmethod
    def convertible(type_):
        """Types whose values are converted to it."""
        sources = [BOOL, *BITS, *INTS, *REALS]
        if type_.kind in ("int", "bits"):
            sources = sources + [TIME, TOD, DATE, DT]
        if type_.kind == "date":
            sources = [DT, *UNSIGNED[:3]]
        if type_.kind in ("tod", "dt"):
            sources = [DT if type_.kind == "tod" else DATE, *UNSIGNED]
        return [] if type_.kind in ("enum", "string") else [one for one in sources if one is not type_]

    def conversion(self, type_, depth):
        rng = self.rng
        source = self.common_here(self.convertible(type_))
        a = self.value(source, depth)
        if a.bare:
            return None
        short = rng.random() < 0.2 and type_ not in (DATE, TOD, DT)
        name = f"TO_{type_.name}" if short else f"{source.name}_TO_{type_.name}"
        return Expr(f"{name}({a.text})", type_, lambda f: convert(source, type_, a.run(f)))

    # BOOL

    def comparison(self, _type, depth):
        rng = self.rng
        kind = self.common_here([*INTS, *INTS, *REALS, *BITS, TIME, TOD, DATE, DT, BOOL])
        kind = rng.choice([kind] * 8 + ["string", "enum"])
        ops = ["=", "<>", "<", ">", "<=", ">="]
        if kind == "string":
            a, b, type_ = self.text(depth), self.text(depth), None
        elif kind == "enum":
            found = self.paths(lambda t: t.kind == "enum")
            if not found:
                return None
            a = rng.choice(found)
            b, ops, type_ = self.value(a.type, 0), ["=", "<>"], a.type
        else:
            type_ = kind
            both = self.pair(type_, depth)
            if both is None:
                return None
            a, b = both
        op = rng.choice(ops)
        x, y = (a.run, b.run) if type_ is None else (widened(a, type_), widened(b, type_))
        level = tree.EQUAL if op in ("=", "<>") else tree.ORDERED
        return self.infix(op, level, a, b, BOOL, lambda f: do.COMPARE[op](x(f), y(f)))

    def logic(self, type_, depth):
        op = self.rng.choice(("AND", "OR", "XOR", "AND", "OR"))
        both = self.pair(type_, depth)
        if both is None:
            return None
        a, b = both
        level = {"AND": tree.AND, "OR": tree.OR, "XOR": tree.XOR}[op]
        shown = "&" if op == "AND" and self.rng.random() < 0.2 else op
        x, y = a.run, b.run
        if type_.kind == "bool" and op != "XOR":  # the right side only where it decides
            run = (lambda f: x(f) and y(f)) if op == "AND" else (lambda f: x(f) or y(f))
        else:
            run = lambda f: do.bitwise(op, type_, x(f), y(f))
        return self.infix(shown, level, a, b, type_, run)

    def negation(self, type_, depth):
        a = self.value(type_, depth)
        if a.bare:
            return None
        return Expr(f"NOT {a.at(tree.PRIMARY, self.rng)}", type_, lambda f: do.inverted(type_, a.run(f)), tree.SIGN)

    # Times

    def times(self, type_, depth):
        rng = self.rng
        if type_.kind == "date":
            return None
        if type_.kind != "time":
            a, b = self.value(type_, depth), self.value(TIME, depth)
            minus = rng.random() < 0.4
            return self.infix("-" if minus else "+", tree.SUM, a, b, type_,
                              lambda f: do.time_sum(type_, a.run(f), -b.run(f) if minus else b.run(f)))
        choice = rng.random()
        if choice < 0.4:
            a, b, op = self.value(TIME, depth), self.value(TIME, depth), rng.choice("+-")
            return self.infix(op, tree.SUM, a, b, TIME, lambda f: do.arithmetic(op, TIME, a.run(f), b.run(f)))
        if choice < 0.55:
            kind = rng.choice((DATE, TOD, DT))
            a, b = self.value(kind, depth), self.value(kind, depth)
            return self.infix("-", tree.SUM, a, b, TIME, lambda f: wrap(TIME, a.run(f) - b.run(f)))
        if choice < 0.65:
            a = self.value(TIME, depth)
            return Expr(f"-{a.at(tree.PRIMARY)}", TIME, lambda f: wrap(TIME, -a.run(f)), tree.SIGN)
        a, divide = self.value(TIME, depth), rng.random() < 0.4
        number = rng.choice(INTS + REALS)
        b = self.value(number, 0) if rng.random() < 0.6 else literals.of_value(rng, INT, rng.choice((2, 3, 10)), False)
        if divide and not b.bare:
            b = literals.of_value(rng, number, rng.choice((2, 5)) if number.kind == "int" else 2.5)
        return self.infix("/" if divide else "*", tree.PRODUCT, a, b, TIME, lambda f: do.scaled(a.run(f), b.run(f), divide))

    # Texts

    def text(self, depth):
        rng = self.rng
        if depth > 0 and rng.random() < 0.5:
            return rng.choice(CALLS["string"])(self, None, depth - 1)
        found = self.paths(lambda t: t.kind == "string") if rng.random() < 0.7 else []
        if found:
            return rng.choice(found)
        value = literals.some_value(rng, SHORT_TEXT)
        return literals.of_value(rng, SHORT_TEXT, value)

    # Calls

    def selection(self, type_, depth):
        rng = self.rng
        if type_.kind == "enum" or rng.random() < 0.5:
            g = self.value(BOOL, depth)
            a, b = (self.value(type_, depth) for _ in "ab")
            if a.bare or b.bare:
                return None
            named = rng.random() < 0.2
            text = f"SEL(G := {g.text}, IN0 := {a.text}, IN1 := {b.text})" if named else f"SEL({g.text}, {a.text}, {b.text})"
            return Expr(text, type_, lambda f: do.selected(g.run(f), a.run(f), b.run(f)))
        inputs = self.several(type_, rng.randint(2, 4), depth)
        k = self.value(rng.choice(INTS), 0)
        last = len(inputs) - 1
        selector, run = k.text, k.run
        if rng.random() < 0.95:
            if k.bare:
                return None
            selector, run = f"LIMIT({k.type.plain.name}#0, {k.text}, {last})", lambda f: do.limit(0, k.run(f), last)
        runs = [widened(one, type_) for one in inputs]
        return Expr(f"MUX({selector}, {', '.join(one.text for one in inputs)})", type_,
                    lambda f: do.mux(run(f), *[one(f) for one in runs]))

    def callable(self):
        return [*self.scope.functions, *(one for one in self.scope.changers() if isinstance(one, parts.BoundMethod))]

    def user_call(self, type_, depth):
        function = self.rng.choice([one for one in self.callable() if one.result is type_])
        return function.call(self, depth)

    def into(self, type_, depth=3):
        """What can be assigned to a variable of the type: text and value as it is stored."""
        rng = self.rng
        plain = type_.plain
        if plain.kind in ("array", "struct"):
            found = self.paths(lambda t: t is type_)
            return rng.choice(found) if found else None
        if plain.kind in ("int", "real", "bits") and rng.random() < 0.1 and type_.low is None:
            return literals.of_value(rng, plain, literals.some_value(rng, plain), typed=False)
        made = self.operand(plain, depth, bare=type_.low is None and rng.random() < 0.1)
        if made is None:
            return self.into(type_, depth)
        run = widened(made, plain)
        if type_.low is not None:
            return self.in_subrange(type_, made, run)
        if plain.kind == "string":
            return Expr(made.text, type_, lambda f: run(f)[:type_.length], made.level)
        return Expr(made.text, type_, run, made.level)

    def in_subrange(self, type_, made, run):
        low, high = type_.low, type_.high
        if self.rng.random() < 0.9 and made.type.plain is type_.plain:
            inner = run
            made = Expr(f"LIMIT({low}, {made.text}, {high})", type_, None)
            run = lambda f: do.limit(low, inner(f), high)
        elif "#" in made.text or re.search(r"\bk\d", made.text):  # what is known to lie outside is refused
            value = self.rng.randint(low, high)
            return Expr(str(value), type_, lambda f: value, tree.SIGN)

        def checked(f):
            value = run(f)
            if not low <= value <= high:
                raise tree.Fault("value")
            return value

        return Expr(made.text, type_, checked, made.level)
