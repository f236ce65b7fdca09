#!/usr/bin/env python3
"""Every function outside of the project that the tick path can reach is on the list tick_services.txt. What a kernel
without Linux has to offer is that list; what allocates or may block is not on it.
check_tick.py LIST SYSTEM LIBRARY.a...
SYSTEM is the folder of core/rt/ that is linked: lines `service/SYSTEM` count for it only. As for the linker the first library that
has a function counts.

Followed are the calls and addresses in the machine code of the static libraries, from the roots on. Calls through tables
(virtual functions, hooks) are not seen: what they lead to is a root of its own."""

import collections
import fnmatch
import pathlib
import re
import subprocess
import sys

import common

FUNCTION = re.compile(r"^([0-9a-f]+) <(.+)>:$")
SECTION = re.compile(r"^Disassembly of section (\S+):$")
DIRECT = re.compile(r"\s(?:call|j\w+)\s+[0-9a-f]+ <([^>+]+)")
RELOCATION = re.compile(r"^\s+[0-9a-f]+: R_X86_64_\w+\s+(\S+?)([+-]0x[0-9a-f]+)?$")
SKIPPED = 77


def demangled(names):
    names = list(names)
    plain = subprocess.run(["c++filt"], input="\n".join(names), capture_output=True, text=True, check=True).stdout
    return dict(zip(names, plain.splitlines()))


class Code:
    """Who calls whom: `calls` by (object, function)."""

    def __init__(self):
        self.calls = collections.defaultdict(set)
        self.known = collections.defaultdict(list)  # by function: the objects that have it
        self.data = set()

    def add(self, library):
        text = subprocess.run(["objdump", "-dr", "--no-show-raw-insn", library], capture_output=True, text=True,
                              check=True).stdout
        symbols = subprocess.run(["nm", "--defined-only", library], capture_output=True, text=True, check=True).stdout
        self.data.update(line.split()[2] for line in symbols.splitlines() if len(line.split()) == 3)
        member, section, function = "", "", ""
        starts = collections.defaultdict(list)  # of the functions of a section
        later = []  # references into sections, by offset
        target = None  # of a jump; what it shows means nothing if a relocation follows
        for line in text.splitlines():
            if target and not RELOCATION.match(line):
                self.calls[function].add(target)
            target = None
            if line.endswith("file format elf64-x86-64"):
                self.resolve(starts, later)
                starts, later = collections.defaultdict(list), []
                member = f"{library}:{line.split(':')[0]}"
            elif match := SECTION.match(line):
                section = match[1]
            elif match := FUNCTION.match(line):
                function = (member, match[2])
                self.known[match[2]].append(member)
                starts[section].append((int(match[1], 16), function))
            elif match := RELOCATION.match(line):
                if match[1].startswith(".text"):
                    later.append((function, match[1], int(match[2] or "0", 16) + 4))
                elif not match[1].startswith("."):
                    self.calls[function].add(match[1])
            elif match := DIRECT.search(line):
                target = match[1]
        self.resolve(starts, later)

    def resolve(self, starts, later):
        for function, section, offset in later:
            before = [name for start, name in starts[section] if start <= offset]
            if before:
                self.calls[function].add(before[-1][1])

    def reached(self, roots):
        """Of each function that is not here, one way that leads to it."""
        ways = {}
        todo = [(member, name) for name in roots for member in self.known[name]]
        came = {function: None for function in todo}
        while todo:
            function = todo.pop()
            for called in self.calls[function]:
                # A local function of the same object comes first.
                objects = [function[0]] if function[0] in self.known[called] else self.known[called][:1]
                if not objects and called not in self.data:
                    ways.setdefault(called, function)
                for member in objects:
                    if (member, called) not in came:
                        came[(member, called)] = function
                        todo.append((member, called))
        return ways, came


def way_to(function, came):
    names = []
    while function is not None:
        names.append(function[1])
        function = came[function]
    return names[::-1]


def check(listing, system, libraries):
    rows = [line.split(None, 1) for line in pathlib.Path(listing).read_text().splitlines()
            if line.strip() and not line.startswith("#")]
    patterns = {kind: [row[1].split("  ")[0].strip() for row in rows if row[0] == kind]
                for kind in ("root", "service", "leaf", f"service/{system}")}
    patterns["service"] += patterns[f"service/{system}"]
    code = Code()
    for library in libraries:
        code.add(library)
    plain = demangled(code.known)

    def named(pattern):
        return [name for name in code.known if fnmatch.fnmatchcase(plain[name], pattern)]
    findings = [f"{listing}: no function is called {pattern}" for pattern in patterns["root"] + patterns["leaf"]
                if not named(pattern)]
    for pattern in patterns["leaf"]:
        for name in named(pattern):
            for member in code.known[name]:
                code.calls[(member, name)] = set()
    ways, came = code.reached({name for pattern in patterns["root"] for name in named(pattern)})
    outside = demangled(ways)
    for name, last in sorted(ways.items()):
        if not any(fnmatch.fnmatchcase(outside[name], pattern) for pattern in patterns["service"]):
            way = demangled(way_to(last, came))
            findings.append(f"{outside[name]} is not in {listing}; reached by {' > '.join(way.values())}")
    used = {pattern for pattern in patterns["service"] for name in ways if fnmatch.fnmatchcase(outside[name], pattern)}
    findings += [f"{listing}: nothing on the tick path uses {pattern} any more"
                 for pattern in patterns["service"] if pattern not in used]
    return findings


if __name__ == "__main__":
    if subprocess.run(["uname", "-m"], capture_output=True, text=True, check=True).stdout.strip() != "x86_64":
        print("skipped: reads the machine code of x86-64")
        sys.exit(SKIPPED)
    common.report(check(sys.argv[1], sys.argv[2], sys.argv[3:]))
