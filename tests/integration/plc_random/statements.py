# SPDX-License-Identifier: Apache-2.0
"""Random statements. Every loop ends after a few rounds."""

import aliases
import functions as do
import literals
import tree
from expressions import Maker
from kinds import BITS, BOOL, INT, INTS, PART_LETTERS, clone, wrap
from order import Witness
from tree import Continue, Exit, Jump, Return, Rounds, Stmt, indent, sequence, text_of
from units import root


def store(target, run):
    def assign(f):
        value = clone(run(f))
        container, key = target.slot(f)
        container[key] = value

    return assign


class Writer:
    def __init__(self, rng, scope, returns=True, pointers=()):
        self.rng = rng
        self.scope = scope
        self.make = Maker(rng, scope)
        self.returns = returns
        self.pointers = pointers
        self.loops = 0
        self.labels = 0

    def body(self, count, depth=2):
        out = []
        while len(out) < count:
            one = self.statement(depth)
            if one is not None:
                out.append(one)
        return out

    def outermost(self, count):
        """A body; jumps go forward in it."""
        bound = aliases.make_pointers(self.rng, self.scope, self.pointers) if self.pointers else []
        out = self.body(count)
        if self.rng.random() < 0.15 and len(out) > 3:
            self.labels += 1
            label = f"skip{self.labels}"
            condition = self.make.value(BOOL, 1)
            at = self.rng.randrange(len(out) - 1)
            to = self.rng.randrange(at + 1, len(out))

            def jump(f):
                if condition.run(f):
                    raise Jump(label)

            out.insert(to, Stmt([f"{label}:"], lambda f: None, label))
            out.insert(at, Stmt([f"IF {condition.text} THEN JMP {label}; END_IF;"], jump))
        return bound + out

    def statement(self, depth):
        rng = self.rng
        self.make.begin()
        options = [self.assign] * 10 + [self.call] * 3 + [self.set_bit, self.set_part, self.set_or_reset, self.chain]
        if self.scope.pointers:
            options += [lambda _depth: aliases.rebind(self.rng, self.scope)]
        if self.scope.changing:
            options += [lambda _depth: Witness(self).statement()] * 3
        if depth > 0:
            options += [self.branch] * 3 + [self.case, self.for_loop, self.for_loop, self.guarded_loop]
        if self.loops and depth < 2:
            options += [self.leave_loop]
        if depth < 2 and self.returns:
            options += [self.leave] if rng.random() < 0.3 else []
        return rng.choice(options)(depth)

    # Assignments

    def assign(self, _depth):
        found = self.make.paths(lambda t: True, writable=True)
        if not found:
            return None
        scalars = [one for one in found if one.type.kind not in ("array", "struct")]
        target = self.rng.choice(scalars if scalars and self.rng.random() < 0.9 else found)
        callable_ = [one for one in self.scope.functions if not one.pure and one.result is target.type.plain]
        if callable_ and target.type.low is None and self.rng.random() < 0.6:
            return self.assign_call(target, self.rng.choice(callable_))
        value = self.make.into(target.type)
        if value is None:
            return None
        return Stmt([f"{target.text} := {value.text};"], store(target, value.run))

    def assign_call(self, target, function):
        if "[" in target.text:
            return None
        value = function.call(self.make, 1, {root(target)})
        if value is None:
            return None
        return Stmt([f"{target.text} := {value.text};"], store(target, lambda f: stored_in(target.type, value.run(f))))

    def set_bit(self, _depth):
        found = self.make.paths(lambda t: t.kind in ("bits", "int") and t.low is None, writable=True)
        if not found:
            return None
        target = self.rng.choice(found)
        number = self.rng.randrange(target.type.bits)
        value = self.make.value(BOOL, 2)

        def run(f):
            on = value.run(f)
            container, key = target.slot(f)
            old = container[key] & ((1 << target.type.bits) - 1)
            new = old | 1 << number if on else old & ~(1 << number)
            container[key] = wrap(target.type, new)

        return Stmt([f"{target.text}.{number} := {value.text};"], run)

    def set_part(self, _depth):
        found = self.make.paths(lambda t: t.kind == "bits" and t.low is None and t.bits > 8, writable=True)
        if not found:
            return None
        target = self.rng.choice(found)
        part = self.rng.choice([one for one in BITS if one.bits < target.type.bits])
        number = self.rng.randrange(target.type.bits // part.bits)
        value = self.make.value(part, 2)
        mask = ((1 << part.bits) - 1) << number * part.bits

        def run(f):
            new = value.run(f) << number * part.bits
            container, key = target.slot(f)
            container[key] = container[key] & ~mask | new

        return Stmt([f"{target.text}.%{PART_LETTERS[part.bits]}{number} := {value.text};"], run)

    def set_or_reset(self, _depth):
        found = self.make.paths(lambda t: t is BOOL, writable=True)
        if not found:
            return None
        target, value, on = self.rng.choice(found), self.make.value(BOOL, 2), self.rng.random() < 0.5

        def run(f):
            if value.run(f):
                container, key = target.slot(f)
                container[key] = on

        return Stmt([f"{target.text} {'S' if on else 'R'}= {value.text};"], run)

    def chain(self, _depth):
        """a := b := value; of one type, so that nothing is converted on the way."""
        found = [one for one in self.make.paths(lambda t: t.kind not in ("array", "struct"), writable=True)
                 if "[" not in one.text]
        if not found:
            return None
        last = self.rng.choice(found)
        same = [one for one in found if one.type is last.type]
        targets = [self.rng.choice(same) for _ in range(self.rng.randint(1, 2))] + [last]
        value = self.make.into(last.type)
        if value is None:
            return None

        def run(f):
            result = clone(value.run(f))
            for one in reversed(targets):
                container, key = one.slot(f)
                container[key] = clone(result)

        return Stmt([f"{' := '.join(one.text for one in targets)} := {value.text};"], run)

    def call(self, _depth):
        instances = self.scope.instances()
        if not instances:
            return None
        variable = self.rng.choice(instances)
        return variable.instance.call(self.make, variable, 1)

    # Branches

    def branch(self, depth):
        arms = [(self.make.value(BOOL, 2), self.body(self.rng.randint(1, 3), depth - 1))]
        while self.rng.random() < 0.3:
            arms.append((self.make.value(BOOL, 1), self.body(1, depth - 1)))
        other = self.body(self.rng.randint(1, 2), depth - 1) if self.rng.random() < 0.5 else None
        lines = []
        for i, (condition, body) in enumerate(arms):
            lines += [f"{'IF' if i == 0 else 'ELSIF'} {condition.text} THEN", *indent(text_of(body))]
        if other is not None:
            lines += ["ELSE", *indent(text_of(other))]
        runs = [(condition.run, sequence(body)) for condition, body in arms]
        runs.append((lambda f: True, sequence(other or [])))

        def run(f):
            next(body for condition, body in runs if condition(f))(f)

        return Stmt([*lines, "END_IF;"], run)

    def case(self, depth):
        rng = self.rng
        enums = self.make.paths(lambda t: t.kind == "enum")
        if enums and rng.random() < 0.5:
            value = rng.choice(enums)
            labels = [[(literals.of_value(rng, value.type, v).text, v, v)] for _, v in value.type.items]
            rng.shuffle(labels)
            labels = labels[:rng.randint(1, len(labels))]
        else:
            type_ = self.make.common_here(INTS)
            value = self.make.value(type_, 2)
            labels = self.number_labels(value.type)
            if not labels:
                return None
        arms = [(one, self.body(rng.randint(1, 2), depth - 1)) for one in labels]
        other = self.body(1, depth - 1) if rng.random() < 0.6 else None
        lines = [f"CASE {value.text} OF"]
        for one, body in arms:
            lines += [f"  {', '.join(text for text, _, _ in one)}:", *indent(indent(text_of(body)))]
        if other is not None:
            lines += ["ELSE", *indent(text_of(other))]
        runs = [(one, sequence(body)) for one, body in arms]
        rest = sequence(other or [])

        def run(f):
            number = value.run(f)
            for one, body in runs:
                if any(low <= number <= high for _, low, high in one):
                    return body(f)
            return rest(f)

        return Stmt([*lines, "END_CASE;"], run)

    def number_labels(self, type_):
        """Disjoint numbers and ranges in some arms."""
        rng, at, out = self.rng, rng_start(self.rng, type_), []
        for _ in range(rng.randint(1, 4)):
            arm = []
            for _ in range(rng.randint(1, 3)):
                low = at + rng.randint(0, 3)
                high = low + rng.choice((0, 0, 2, 5))
                if high > (type_.greatest() if type_.high is None else type_.high):
                    break
                arm.append((str(low) if low == high else f"{low}..{high}", low, high))
                at = high + 1
            if arm:
                out.append(arm)
        return out

    # Loops

    def for_loop(self, depth):
        rng = self.rng
        found = [one for one in self.scope.places(True) if one.type.kind == "int"]
        if not found:
            return None
        reached = [one for one in found if any(one.name in pointer.targets for pointer in self.scope.pointers)]
        variable = rng.choice(reached if reached and rng.random() < 0.6 else found)
        type_ = variable.type
        least, greatest = (type_.least(), type_.greatest()) if type_.low is None else (type_.low, type_.high)
        step = rng.choice((1, 1, 1, 2, 3, -1, -2) if type_.signed else (1, 1, 2, 3))
        start = rng.choice((0, 1, least, greatest - 3, rng.randint(-5, 5)))
        start = min(max(start, least), greatest)
        end = min(max(start + step * rng.randint(-1, 5), least), greatest)
        first = literals.of_value(rng, type_.plain, start, typed=rng.random() < 0.3)
        last = literals.of_value(rng, type_.plain, end, typed=rng.random() < 0.3)
        constant = rng.random() < 0.6
        if not constant:
            last = self.bounded(type_, end, start) or last
        by = f" BY {step}" if step != 1 or rng.random() < 0.1 else ""
        self.scope.locked.add(variable.name)
        known = constant and step != 0 and variable.name not in self.scope.ranges
        if known and (start <= end if step > 0 else start >= end):
            self.scope.ranges[variable.name] = (min(start, end), max(start, end))
        self.loops += 1
        body = self.body(rng.randint(1, 3), depth - 1)
        self.loops -= 1
        self.scope.locked.discard(variable.name)
        self.scope.ranges.pop(variable.name, None)
        lines = [f"FOR {variable.name} := {first.text} TO {last.text}{by} DO", *indent(text_of(body)), "END_FOR;"]
        return Stmt(lines, counted(self.scope.read(variable), first, last, step, sequence(body), (least, greatest)))

    def bounded(self, type_, end, start):
        """Not known before, but near the start."""
        found = self.make.variable(type_.plain)
        if found is None:
            return None
        low, high = min(start, end), max(start, end)
        name = type_.plain.name
        run = found.run
        text = f"LIMIT({literals.of_value(self.rng, type_.plain, low).text}, {found.text}, {name}#{high})"
        return tree.Expr(text, type_.plain, lambda f: do.limit(low, run(f), high))

    def guarded_loop(self, depth):
        """WHILE or REPEAT with a counter of its own that ends it."""
        rng = self.rng
        found = [one for one in self.scope.places(True) if one.type.plain is INT and one.type.low is None]
        if not found:
            return None
        counter = rng.choice(found)
        most = rng.randint(1, 5)
        self.scope.locked.add(counter.name)
        condition = self.make.value(BOOL, 2)
        self.loops += 1
        body = self.body(rng.randint(1, 2), depth - 1)
        self.loops -= 1
        self.scope.locked.discard(counter.name)
        name, read = counter.name, self.scope.read(counter)
        set_to = lambda f, value: read.slot(f)[0].__setitem__(read.slot(f)[1], value)
        inner = sequence(body)
        repeat = rng.random() < 0.4

        def rounds(f):
            set_to(f, 0)
            left = Rounds()
            while repeat or (read.run(f) < most and condition.run(f)):
                left.take()
                set_to(f, wrap(INT, read.run(f) + 1))
                try:
                    inner(f)
                except Continue:
                    pass
                if repeat and (read.run(f) >= most or condition.run(f)):
                    break

        def run(f):
            try:
                rounds(f)
            except Exit:
                pass

        step = indent([f"{name} := {name} + 1;", *text_of(body)])
        if repeat:
            lines = [f"{name} := 0;", "REPEAT", *step, f"UNTIL {name} >= {most} OR {condition.at(tree.XOR)}", "END_REPEAT;"]
        else:
            lines = [f"{name} := 0;", f"WHILE {name} < {most} AND {condition.at(tree.EQUAL)} DO", *step, "END_WHILE;"]
        return Stmt(lines, run)

    def leave_loop(self, _depth):
        condition = self.make.value(BOOL, 1)
        word, error = self.rng.choice((("EXIT", Exit), ("CONTINUE", Continue)))

        def run(f):
            if condition.run(f):
                raise error

        return Stmt([f"IF {condition.text} THEN {word}; END_IF;"], run)

    def leave(self, _depth):
        condition = self.make.value(BOOL, 1)

        def run(f):
            if condition.run(f):
                raise Return

        return Stmt([f"IF {condition.text} THEN RETURN; END_IF;"], run)


def stored_in(type_, value):
    return value[:type_.length] if type_.kind == "string" else value


def rng_start(rng, type_):
    if type_.low is not None:
        return rng.randint(type_.low, type_.high)
    return max(rng.choice((-5, 0, 1, type_.least(), type_.greatest() - 12)), type_.least())


def counted(variable, first, last, step, body, ends):
    """FOR: start and end are computed once; the variable ends one step beyond, wrapped, but inside of a subrange."""
    least, greatest = ends
    subrange = variable.type.low is not None

    def run(f):
        start, end = first.run(f), last.run(f)
        container, key = variable.slot(f)
        container[key] = start
        left = Rounds()
        try:
            while container[key] <= end if step > 0 else container[key] >= end:
                left.take()
                try:
                    body(f)
                except Continue:
                    pass
                after = container[key] + step
                if not least <= after <= greatest:
                    if not subrange:
                        container[key] = wrap(variable.type.plain, after)
                    return
                container[key] = after
        except Exit:
            pass

    return run
