# SPDX-License-Identifier: Apache-2.0
"""Sequential function charts: a random one as text, and how the standard lets it evolve."""

import literals
import scope as parts
from kinds import BOOL, TIME, Type
from library_blocks import Ton
from statements import Writer
from tree import indent, sequence, text_of

STEP = Type("step", "struct", fields=(("X", BOOL), ("T", TIME)))
TIMED = ("L", "D", "SD", "DS", "SL")


class Action:
    """Everything of one name: where it is associated, and what it does."""

    def __init__(self, name, body=None):
        self.name = name
        self.body = body  # statements; none: a BOOL variable
        self.associations = []  # (step, qualifier, ns)


class Chart:
    def __init__(self, rng, scope, variables):
        self.rng = rng
        self.steps = ["st0"]
        self.transitions = []  # (from, to, condition)
        self.links()
        scope.variables = variables + [parts.Variable(one, STEP, writable=False) for one in self.steps]
        self.writer = Writer(rng, scope, returns=False)
        self.conditions = [self.writer.make.value(BOOL, 2) for _ in self.transitions]
        self.priorities = rng.sample(range(1, 50), len(self.transitions)) if rng.random() < 0.3 else None
        flags = [one.name for one in variables if one.type is BOOL and one.writable and one.store is None]
        self.actions = [Action(f"act{i}", self.writer.body(rng.randint(1, 3), 1)) for i in range(rng.randint(1, 3))]
        self.actions += [Action(one) for one in rng.sample(flags, min(len(flags), 2))]
        self.lines_of = {step: self.associate(step) for step in self.steps}
        self.actions = self.in_order()

    def links(self):
        """Steps behind each other, some of them alternatives or at the same time; the last leads to the first."""
        at = "st0"
        for _ in range(self.rng.randint(1, 3)):
            kind = self.rng.choice(("line", "line", "choice", "both"))
            if kind == "line":
                after = self.step()
                self.transitions.append(([at], [after]))
            else:
                a, b, after = self.step(), self.step(), self.step()
                if kind == "both":
                    self.transitions += [([at], [a, b]), ([a, b], [after])]
                else:
                    self.transitions += [([at], [a]), ([at], [b]), ([a], [after]), ([b], [after])]
            at = after
        self.transitions.append(([at], ["st0"]))

    def step(self):
        self.steps.append(f"st{len(self.steps)}")
        return self.steps[-1]

    def associate(self, step):
        lines = []
        for _ in range(self.rng.randint(0, 3)):
            action = self.rng.choice(self.actions)
            if any(one == step for one, _, _ in action.associations):
                continue
            qualifier = self.rng.choice(("N", "N", "S", "R", "P", "P1", "P0", *TIMED))
            ns = self.rng.choice((0, 10, 20, 500, 1000)) * 10**6
            action.associations.append((step, qualifier, ns))
            shown = f"{qualifier}, {literals.duration(self.rng, ns)}" if qualifier in TIMED else qualifier
            lines.append(f"{action.name}({shown});")
        return lines

    def in_order(self):
        """As they are first named in the text; others never run."""
        names = [line.split("(")[0] for step in self.steps for line in self.lines_of[step]]
        used = [one for one in self.actions if one.associations]
        self.unused = [one for one in self.actions if not one.associations and one.body]
        return sorted(used, key=lambda one: names.index(one.name))

    def text(self):
        out = []
        for step in self.steps:
            out += [f"{'INITIAL_STEP' if step == 'st0' else 'STEP'} {step}:", *indent(self.lines_of[step]), "END_STEP"]
        several = lambda names: names[0] if len(names) == 1 else f"({', '.join(names)})"
        for i, (source, target) in enumerate(self.transitions):
            priority = f" (PRIORITY := {self.priorities[i]})" if self.priorities else ""
            out.append(f"TRANSITION{priority} FROM {several(source)} TO {several(target)} := {self.conditions[i].text}; "
                       "END_TRANSITION")
        for one in (*self.actions, *self.unused):
            if one.body is not None:
                out += [f"ACTION {one.name}:", *indent(text_of(one.body)), "END_ACTION"]
        return out

    def first_values(self):
        return {one: {"X": one == "st0", "T": 0} for one in self.steps}

    def run(self, f):
        state = f.values.setdefault("chart of " + self.steps[0], State(self))
        state.scan(f)


class State:
    """Of one chart at run time."""

    def __init__(self, chart):
        self.chart = chart
        self.running = False
        self.since = {}
        self.before = dict.fromkeys(chart.steps, False)
        self.controls = [Control(one) for one in chart.actions]

    def scan(self, f):
        active = lambda step: f.values[step]["X"]
        self.measure(f, active)  # transitions see the time that it is now
        if self.running:
            self.evolve(f, active)
        self.measure(f, active)
        for one in self.controls:
            one.scan(f, active, self.before)
        self.before = {step: active(step) for step in self.chart.steps}
        self.running = True

    def measure(self, f, active):
        for step in self.chart.steps:
            if not active(step):
                self.since.pop(step, None)
            else:
                f.values[step]["T"] = f.now - self.since.setdefault(step, f.now)

    def evolve(self, f, active):
        """All transitions see the same steps; of those that leave one step the first in the order of priority wins."""
        order = range(len(self.chart.transitions))
        if self.chart.priorities:
            order = sorted(order, key=lambda i: self.chart.priorities[i])
        fired, left = [], set()
        for i in order:
            source, target = self.chart.transitions[i]
            if all(active(one) for one in source) and not left & set(source) and self.chart.conditions[i].run(f):
                fired.append((source, target))
                left |= set(source)
        for source, _ in fired:
            for one in source:
                f.values[one]["X"] = False
        for _, target in fired:
            for one in target:
                f.values[one]["X"] = True


class Control:
    """ACTION_CONTROL of the standard, with its last scan after the action became inactive. A pulse runs once."""

    def __init__(self, action):
        self.action = action
        self.run_body = sequence(action.body) if action.body is not None else None
        self.stored = [False] * len(action.associations)
        self.timers = [Ton() for _ in action.associations]
        self.was_on = False

    def scan(self, f, active, before):
        reset = any(q == "R" and active(step) for step, q, _ in self.action.associations)
        level = pulse = False
        for i, (step, qualifier, ns) in enumerate(self.action.associations):
            if qualifier in ("P", "P1"):
                pulse |= active(step) and not before[step]
            elif qualifier == "P0":
                pulse |= before[step] and not active(step)
            elif qualifier != "R":
                level |= self.level(i, active(step), qualifier, ns, reset, f.now)
        level = level and not reset
        if self.run_body is None:
            level, pulse = level or pulse, False
        runs = level or self.was_on or pulse
        self.was_on = level
        if self.run_body is not None:
            if runs:
                self.run_body(f)
            return
        if runs:
            f.values[self.action.name] = level
        if reset:
            f.values[self.action.name] = False

    def level(self, i, x, qualifier, ns, reset, now):
        if qualifier == "N":
            return x
        if qualifier in ("L", "D"):
            over = self.over(i, x, ns, now)
            return over if qualifier == "D" else x and not over
        if self.over(i, x, ns, now) if qualifier == "DS" else x:
            self.stored[i] = True
        if reset:
            self.stored[i] = False
        if qualifier in ("S", "DS"):
            return self.stored[i]
        over = self.over(i, self.stored[i], ns, now)
        return over if qualifier == "SD" else self.stored[i] and not over

    def over(self, i, on, ns, now):
        timer = self.timers[i]
        timer.values["IN"], timer.values["PT"] = on, ns
        timer.call(now)
        return timer.values["Q"]
