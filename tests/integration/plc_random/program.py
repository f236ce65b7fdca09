# SPDX-License-Identifier: Apache-2.0
"""One random program with its types, functions and function blocks; and the oracle's run of it, scan by scan."""

import random

import aliases
import library_blocks
import literals
import scope as parts
import tree
from chart import Chart
from kinds import BITS, BOOL, ELEMENTARY, INT, INTS, STRING, TIME, Type, clone, string
from order import make_changer, make_mix
from statements import Writer
from tree import Fault, Frame, Return, indent, sequence, text_of
from units import START, Function, LibraryBlock, Method, Parameter, Start, Started, UserBlock, declared

TIMES = [START, *(ms * 10**6 for ms in (1010, 1020, 1040, 1540, 1550, 3050, 3060))]


# Words of C++ and IDL, macros, and what the compiler itself may call something.
HARD = """new default result out_b case_1 case_2 loop_1 counter_1 end_1 begin_1 enabled_1 this delete operator signed _x x__y NULL
EOF std iec irp shared before scan kept errno assert __FILE__ __LINE__ switch goto register double float unsigned template
virtual INT_MAX M_PI Image run main plc new_ new__ result_ value_type get any sequence octet in0_edge indurop_x void char""".split()


MOST_LEVELS = 3  # of arrays in arrays, as the compiler says


def levels(type_):
    return 1 + levels(type_.element) if type_.kind == "array" else 0


class Program:
    def __init__(self, seed, number):
        self.rng = random.Random(seed)
        self.seed = seed
        self.number = number
        self.prefix = f"P{number}"
        self.starts = (seed - 1) // 100 % 2 == 1  # FB_Init, which PLCopen XML does not have
        self.pointer_kinds = aliases.KINDS if self.starts else aliases.EXPORTED
        self.palette = self.rng.sample(ELEMENTARY, 5) + [INT, BOOL]  # so that variables have types in common
        self.type_lines = []
        self.types = []
        self.functions = []
        self.blocks = []
        self.make_types()
        self.make_globals()
        self.make_changers()
        for i in range(self.rng.randint(0, 2)):
            self.make_function(i)
        for i in range(self.rng.randint(0, 2)):
            self.make_block(i)
        self.make_body()

    # Types

    def make_types(self):
        rng = self.rng
        for i in range(rng.randint(0, 4)):
            made = rng.choice((self.enumeration, self.subrange, self.array, self.structure, self.alias))(f"{self.prefix}_T{i}")
            self.types.append(made)

    def enumeration(self, name):
        rng, value, items, shown = self.rng, 0, [], []
        for i in range(rng.randint(2, 5)):
            gap = i > 0 and rng.random() < 0.2
            value += rng.randint(1, 9) if gap else i > 0
            items.append((f"{name}_V{i}", value))
            shown.append(f"{name}_V{i}" + (f" := {value}" if gap else ""))
        self.type_lines.append(f"{name} : ({', '.join(shown)});")
        return Type(name, "enum", 16, True, items=tuple(items))

    def subrange(self, name):
        base = self.rng.choice(INTS)
        low = self.rng.randint(max(base.least(), -50), 20)
        high = low + self.rng.randint(1, 60)
        initial = self.rng.randint(low, high) if self.rng.random() < 0.5 else None
        self.type_lines.append(f"{name} : {base.name} ({low}..{high})" + (f" := {initial};" if initial is not None else ";"))
        return Type(name, base.kind, base.bits, base.signed, low=low, high=high, base=base, initial=initial)

    def alias(self, name):
        base = self.rng.choice([one for one in ELEMENTARY if one is not STRING])
        value = literals.some_value(self.rng, base)
        shown = literals.of_value(self.rng, base, value)
        self.type_lines.append(f"{name} : {base.name} := {shown.text};")
        return Type(name, base.kind, base.bits, base.signed, base=base, initial=value)

    def bounds(self):
        low = self.rng.choice((0, 0, 1, 1, -2, 5))
        return low, low + self.rng.randint(0, 5)

    def array(self, name):
        element = self.any_type(0.5, False)
        if levels(element) == MOST_LEVELS:
            element = element.element
        bounds = tuple(self.bounds() for _ in range(self.rng.choice((1, 1, 1, 2, 3))))
        shown = ", ".join(f"{low}..{high}" for low, high in bounds)
        self.type_lines.append(f"{name} : ARRAY [{shown}] OF {element.name};")
        return Type(name, "array", element=element, bounds=bounds)

    def structure(self, name):
        fields = [(f"m{i}", self.any_type(0.4, False)) for i in range(self.rng.randint(1, 4))]
        self.type_lines.append(f"{name} : STRUCT {' '.join(f'{n} : {t.name};' for n, t in fields)} END_STRUCT;")
        return Type(name, "struct", fields=tuple(fields))

    def any_type(self, own=0.35, deep=True):
        if self.types and self.rng.random() < own:
            found = [one for one in self.types if deep or one.kind != "array" or len(one.bounds) == 1]
            if found:
                return self.rng.choice(found)
        one = self.rng.choice(self.palette if self.rng.random() < 0.9 else ELEMENTARY)
        return string(self.rng.choice((1, 5, 10, 20))) if one is STRING and self.rng.random() < 0.7 else one

    # Variables

    def make_globals(self):
        """Without initial values: they lie in shared memory, of which the driver has none."""
        types = [self.rng.choice(self.palette) for _ in range(self.rng.choice((0, 0, 1, 2)))]
        self.globals = [Parameter(f"{self.prefix}_g{i}", one, "VAR_EXTERNAL") for i, one in enumerate(types)]
        self.global_values = {}
        self.reset_globals()

    def reset_globals(self):
        self.global_values |= {one.name: one.first() for one in self.globals}

    def global_variables(self):
        return [parts.Variable(one.name, one.type, store=self.global_values) for one in self.globals]

    def initial(self, type_):
        if type_.kind in ("array", "struct") or self.rng.random() < 0.5:
            return None
        value = literals.some_value(self.rng, type_)
        return literals.of_value(self.rng, type_, value, typed=self.rng.random() < 0.5 and type_.low is None)

    def parameters(self, section, letter, most, least=0, type_of=None):
        out = []
        for i in range(self.rng.randint(least, most)):
            name = f"{letter}{i}"
            if self.hard and self.rng.random() < 0.25:
                name = self.hard.pop()
            type_ = (type_of or self.any_type)()
            initial = None if section == "VAR_IN_OUT" else self.initial(type_)
            out.append(Parameter(name, type_, section, initial))
        return out

    def make_changers(self):
        """Functions of which every call changes something, for half of the programs."""
        self.changing = []
        if self.rng.random() < 0.5:
            return
        types = [one for one in self.palette if one.kind in ("bool", "bits", "int", "time")]
        for i in range(self.rng.randint(1, 2)):
            type_ = self.rng.choice(types)
            found = [one for one in self.global_variables() if one.type is type_]
            of_all = self.rng.choice(found) if found and self.rng.random() < 0.7 else None
            self.changing.append(make_changer(self.rng, f"{self.prefix}_C{i}", type_, of_all))
            self.functions += [self.changing[-1].function, make_mix(f"{self.prefix}_M{i}", type_)]

    def scope_of(self, variables, with_globals):
        """For a body: what it may call."""
        scope = parts.Scope(variables, [one for one in self.functions if with_globals or not one.globals])
        scope.changing = [one for one in self.changing if with_globals or not one.place]
        return scope

    def make_function(self, i):
        rng = self.rng
        self.hard = rng.sample(HARD, 6)
        pure = rng.random() < 0.5
        kinds = ["VAR_INPUT"] if pure else ["VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"]
        made = [self.parameters(one, one[4:6].lower() + ("n" if one == "VAR_IN_OUT" else ""), 3, one == "VAR_INPUT") for one in kinds]
        rng.shuffle(made)
        parameters = [one for group in made for one in group]
        parameters += self.parameters("VAR", "v", 3, 1)
        while True:
            result = self.any_type(0.2).plain
            if result.kind not in ("array", "struct") and result is not STRING and result.kind != "string":
                break
        function = Function(f"{self.prefix}_F{i}", parameters, result)
        variables = [parts.Variable(one.name, one.type) for one in parameters]
        variables.append(parts.Variable(function.name, result))
        if not pure and rng.random() < 0.7:
            function.globals = self.globals
            variables += self.global_variables()
        scope = self.scope_of(variables, bool(function.globals))
        writer = Writer(rng, scope, pointers=self.pointer_kinds)
        body = writer.outermost(rng.randint(1, 5))
        parameters += [one.parameter() for one in scope.pointers]
        scope.variables = variables
        value = writer.make.into(result)
        last = tree.Stmt([f"{function.name} := {value.text};"], lambda f: f.values.__setitem__(function.name, value.run(f)))
        function.run_body = sequence(body + [last])
        function.lines = text_of(body + [last])
        self.functions.append(function)

    def make_block(self, i):
        rng = self.rng
        self.hard = []
        outputs = self.parameters("VAR_OUTPUT", "ou", 3, 1)  # the driver calls them by their names
        self.hard = rng.sample(HARD, 6)
        parameters = self.parameters("VAR_INPUT", "in", 3, 1)
        if rng.random() < 0.3:
            parameters.append(Parameter("edge", BOOL, "VAR_INPUT", None, rng.choice(("R_EDGE", "F_EDGE"))))
        parameters += outputs + self.parameters("VAR_IN_OUT", "io", 1)
        parameters += self.parameters("VAR", "v", 3, 1) + self.parameters("VAR_TEMP", "t", 1)
        blocks = self.instances(rng.randint(0, 2))
        block = UserBlock(f"{self.prefix}_B{i}", parameters + blocks)
        variables = [parts.Variable(one.name, one.type, edge=bool(one.edge), writable=not one.edge,
                                    lasting=one.section not in ("VAR_IN_OUT", "VAR_TEMP")) for one in parameters]
        variables += [parts.Variable(one.name, None, instance=one.type) for one in blocks]
        if rng.random() < 0.4:
            block.globals = self.globals
            variables += self.global_variables()
        scope = self.scope_of(variables, bool(block.globals))
        scope.keeps_pointers = rng.random() < 0.7
        body = Writer(rng, scope, pointers=self.pointer_kinds).outermost(rng.randint(2, 7))
        block.parameters += [one.parameter() for one in scope.pointers]
        block.run_body = sequence(body)
        block.lines = text_of(body)
        if self.starts and rng.random() < 0.6:
            block.start = self.start_of(variables)
        if self.starts:  # exported as PLCopen XML there are no methods either
            block.methods = [self.method_of(f"Do{i}", variables) for i in range(rng.randint(0, 2))]
        self.blocks.append(block)

    def method_of(self, name, variables):
        """Of a function block with these variables: it changes them."""
        self.hard = []
        parameters = self.parameters("VAR_INPUT", "a", 2, 0, self.plain_type) + self.parameters("VAR", "l", 1)
        result = self.rng.choice([one for one in self.palette if one is not STRING])
        method = Method(name, parameters, result)
        seen = self.seen_in(variables) + [parts.Variable(one.name, one.type) for one in parameters]
        writer = Writer(self.rng, self.scope_of(seen, False))
        body = writer.outermost(self.rng.randint(1, 3))
        value = writer.make.into(result)
        last = tree.Stmt([f"{name} := {value.text};"], lambda f: f.values.__setitem__(name, value.run(f)))
        method.run_body, method.lines = sequence(body + [last]), text_of(body + [last])
        return method

    @staticmethod
    def seen_in(variables):
        """What methods see: not VAR_IN_OUT, VAR_TEMP, inputs with an edge, instances."""
        seen = [one for one in variables if one.name[0] in "iov" and one.name[:2] != "io" and one.instance is None]
        return [one for one in seen if one.name not in HARD]

    def start_of(self, variables):
        """FB_Init of a function block with these variables."""
        self.hard = []
        given = self.parameters("VAR_INPUT", "a", 3, 0, self.plain_type)
        for one in given:
            one.initial = None
        seen = self.seen_in(variables) + [parts.Variable(one.name, one.type) for one in given]
        seen += [parts.Variable(name, BOOL, writable=False) for name in ("bInitRetains", "bInCopyCode")]
        body = Writer(self.rng, self.scope_of(seen, False)).outermost(self.rng.randint(1, 4))
        return Start(given, text_of(body), sequence(body))

    def plain_type(self):
        while True:
            found = self.any_type()
            if found.kind not in ("array", "struct"):
                return found

    def instances(self, count):
        known = [LibraryBlock(one) for one in library_blocks.ALL]
        chosen = [self.rng.choice(self.blocks) if self.blocks and self.rng.random() < 0.5 else self.rng.choice(known)
                  for _ in range(count)]
        return [self.instance(f"b{i}", one) for i, one in enumerate(chosen)]

    def instance(self, name, type_):
        if getattr(type_, "start", None) is None:
            return Parameter(name, type_, "VAR_BLOCK")
        for _ in range(5):
            wanted = [one.type for one in type_.start.parameters]
            given = [literals.of_value(self.rng, one, literals.some_value(self.rng, one)) for one in wanted]
            made = Started(name, type_, "VAR_BLOCK", given=given, by_position=self.rng.randint(0, len(given)))
            try:
                made.new()
                return made
            except Fault:
                continue
        return Parameter(name, LibraryBlock(library_blocks.ALL[0]), "VAR_BLOCK")  # all values end in a fault

    # The program

    def make_body(self):
        rng = self.rng
        self.hard = []
        self.variables = self.parameters("VAR", "x", 14, 6)
        self.variables += [Parameter("n0", INT, "VAR"), Parameter("s0", STRING, "VAR"), Parameter("t0", TIME, "VAR"),
                           Parameter("w0", rng.choice(BITS), "VAR")]
        self.blocks_used = self.instances(rng.randint(0, 4))
        variables = [parts.Variable(one.name, one.type) for one in self.variables]
        constants = self.parameters("VAR CONSTANT", "k", 2, 0, lambda: rng.choice([*INTS, BOOL, TIME, *BITS]))
        for one in constants:
            if one.initial is None:
                one.initial = literals.of_value(rng, one.type, literals.some_value(rng, one.type))
        variables += [parts.Variable(one.name, one.type, writable=False) for one in constants]
        variables += [parts.Variable(one.name, None, instance=one.type) for one in self.blocks_used]
        self.constants = constants
        seen = self.sight_of_globals()
        variables += self.global_variables()
        self.chart = None
        self.pointers = []
        if rng.random() < 0.2:
            self.chart = Chart(rng, self.scope_of(variables, True), variables)
            self.body, self.lines = self.chart.run, self.chart.text()
            return
        scope = self.scope_of(variables, True)
        scope.keeps_pointers = rng.random() < 0.7
        body = seen + Writer(rng, scope, pointers=self.pointer_kinds).outermost(rng.randint(6, 18))
        self.pointers = [one.parameter() for one in scope.pointers]
        self.body = sequence(body)
        self.lines = text_of(body)

    def sight_of_globals(self):
        """Statements that show globals, as the last scan left them, in variables of the program."""
        out = []
        for i, one in enumerate(self.globals):
            shown = Parameter(f"seen{i}", one.type, "VAR")
            self.variables.append(shown)
            out.append(tree.Stmt([f"{shown.name} := {one.name};"],
                                 lambda f, to=shown.name, name=one.name: f.values.__setitem__(to, clone(self.global_values[name]))))
        return out

    def text(self):
        out = [f"(* {self.prefix}: seed {self.seed} *)"]
        if self.globals:
            out += ["VAR_GLOBAL", *(f"  {one.line()}" for one in self.globals), "END_VAR"]
        if self.type_lines:
            out += ["TYPE", *indent(self.type_lines), "END_TYPE"]
        for one in (*self.functions, *self.blocks):
            out += one.text()
        shown = [*self.variables, *self.constants, *self.globals, *self.pointers]
        out += [f"PROGRAM {self.prefix}", *declared(shown), *self.block_lines(), *indent(self.lines), "END_PROGRAM", ""]
        return [line.replace("VAR_BLOCK", "VAR") for line in out]

    def block_lines(self):
        return declared(self.blocks_used)

    def scans(self):
        """After each scan: (fault or None, the values)."""
        self.reset_globals()
        values = {one.name: one.first() for one in (*self.variables, *self.constants, *self.pointers)}
        values |= {one.name: one.new() for one in self.blocks_used}
        values |= self.chart.first_values() if self.chart else {}
        for now in TIMES:
            fault = None
            try:
                self.body(Frame(values, now))
            except Return:
                pass
            except Fault as error:
                fault = str(error)
            yield fault, {one.name: clone(values[one.name]) for one in self.variables} | self.outputs(values)
            if fault is not None:
                return

    def ends(self):
        """Whether all loops do: through a pointer their variables may be set back again and again."""
        try:
            return [None for _ in self.scans()] != []
        except tree.Endless:
            return False

    def outputs(self, values):
        return {f"{one.name}.{name}": clone(values[one.name].values[name])
                for one in self.blocks_used for name, _ in outputs_of(one.type)}


def outputs_of(instance):
    """What can be read of an instance: (name, type)."""
    if isinstance(instance, LibraryBlock):
        return list(instance.made.outputs)
    return [(one.name, one.type) for one in instance.of("VAR_OUTPUT")]
