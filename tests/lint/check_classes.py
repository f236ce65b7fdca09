#!/usr/bin/env python3
"""A class is one idea: it is implemented in at most 3 .cpp files, has at most 25 data members and at most 40 member
functions. Static and deleted members do not count, and data members of a struct without a private part do not either:
it is plain data. A scan of the text: nothing is compiled. check_classes.py ROOT"""

import pathlib
import posixpath
import re
import sys

import check_functions
import common

MOST = {"files": 3, "data members": 25, "functions": 40}
# What is larger than that, with its numbers and the reason. A number may only shrink: one that is too large here is a
# finding, too, and so is an entry that is no longer needed.
ALLOWED = {}

CLASS = re.compile(r"\b(class|struct)\s+(?:\[\[[^\]]*\]\]\s*)?(?:alignas\([^)]*\)\s*)?((?:\w+::)*\w+)\s*(?:final\s*)?"
                   r"(?::(?!:)[^;{}()]*(?:\([^;{}()]*\)[^;{}()]*)?)?\{")
DEFINITION = re.compile(r"(?<![\w:])(~?\w+(?:::~?\w+)*::(?:operator\s*[^\s(\w]+|operator\s+\w+|~?\w+))\s*\(")
SKIP = re.compile(r"(?:using|typedef|friend|static_assert|static|enum|constexpr|inline static|inline constexpr|extern)\b")
FUNCTION_POINTER = re.compile(r"\(\s*(?:\w+::)?\*\s*(?:const\s+)?\w+\s*(?:\[[^\]]*\])?\)\s*\([^()]*\)")


def closing(text, start):
    """Index after the brace that closes the one at `start`."""
    depth = 0
    for found in re.finditer(r"[{}]", text[start:]):
        depth += 1 if found.group() == "{" else -1
        if depth == 0:
            return start + found.end()
    return len(text)


def without(text, opening, ending):
    """The text without what stands in these brackets; an arrow or a comparison opens none."""
    kept, depth = [], 0
    for i, mark in enumerate(text):
        if mark == opening and (opening != "<" or re.search(r"\w\s?$", text[:i])):
            depth += 1
        elif mark == ending and depth > 0:
            depth -= 1
        elif depth == 0:
            kept.append(mark)
    return "".join(kept)


def statements(body):
    """The declarations of a class body, each without what is in its braces, and whether it has a body of its own."""
    start = i = 0
    round_open = 0
    text = ""
    while i < len(body):
        mark = body[i]
        if mark in "()":
            round_open += 1 if mark == "(" else -1
        if mark == ";" and round_open == 0:
            yield text + body[start:i]
            start, text = i + 1, ""
        elif mark == "{" and round_open == 0:
            end = closing(body, i)
            text += body[start:i] + "{}"
            following = body[end:].lstrip()
            start = i = end
            is_type = re.search(r"\b(?:class|struct|union|enum)\b[^()]*\{\}$", text)
            if not is_type and following[:1] not in (";", ",", "{") and not re.match(r"\w[\w_]*\s*;", following):
                yield text
                text = ""
            continue
        elif mark == "{":
            i = closing(body, i)
            continue
        i += 1


def count(body, private):
    """Numbers of data members and of functions that are declared in a class body; `private`: before any label."""
    data = functions = 0
    for statement in statements(body):
        private = private or re.search(r"\b(?:private|protected)\s*:(?!:)", statement) is not None
        bare = re.sub(r"\b(?:public|private|protected)\s*:(?!:)", " ", statement)
        bare = re.sub(r"\boperator\s*(?:[^\s\w(]+|\(\))", "operator_x", bare)
        bare = without(bare, "<", ">")
        bare = re.sub(r"\[\[[^\]]*\]\]|\b(?:alignas|decltype|noexcept|explicit)\s*\((?:[^()]|\([^()]*\))*\)", " ", bare)
        bare = re.sub(r"^\s*template\b", " ", bare).strip()
        if not bare or re.match(r"(?:class|struct|union)\s+[\w:]+\s*(?:final\s*)?$", bare):
            continue
        nested = re.match(r"(?:class|struct|union|enum)\b[^(){}]*\{\}\s*(.*)$", bare, re.DOTALL)
        if nested:
            data += len([name for name in nested.group(1).split(",") if name.strip()])
            continue
        pointer = FUNCTION_POINTER.search(bare)
        head = re.split(r"=|\{", bare, maxsplit=1)[0]
        if "(" in head and not pointer:
            deleted = re.search(r"=\s*delete\s*$", bare) is not None
            functions += 0 if SKIP.match(bare) and not re.match(r"(?:static|constexpr)\b", bare) or deleted else 1
        elif not SKIP.match(bare):
            plain = without(without(without(bare, "{", "}"), "(", ")"), "[", "]")
            data += 1 + plain.count(",")
    return data if private else 0, functions


def classes(bare):
    """Name, offset, keyword and body of each class of a text without comments; an inner one is `Outer::Inner`."""
    ends = []  # of the classes around
    for found in CLASS.finditer(bare):
        if re.search(r"\benum\s*$", bare[:found.start()]):
            continue
        start = found.end() - 1
        end = closing(bare, start)
        ends = [(name, last) for name, last in ends if last > start]
        name = "::".join([outer for outer, _ in ends] + [found.group(2)])
        ends.append((name if not ends else found.group(2), end))
        yield name, found.start(), found.group(1), bare[start + 1:end - 1]


def homes(name, declared, includes):
    """The files that may declare the class whose function a .cpp file defines: itself, what it includes, its folder."""
    for chosen in (lambda f: f == name, lambda f: f in includes,
                   lambda f: posixpath.dirname(f) == posixpath.dirname(name)):
        found = [file for file in declared if chosen(file)]
        if found:
            return found[0]
    return None


def measure(root):
    """(line, .cpp files, data members, functions) of each class, by its file and name."""
    texts = {name: common.read(root, name) for name in common.cxx_files(root) if not name.startswith("tests/")}
    sizes, declared = {}, {}
    bares = {name: check_functions.blank(text) for name, text in texts.items()}
    for name, bare in bares.items():
        for one, offset, kind, body in classes(bare):
            sizes[name, one] = [bare.count("\n", 0, offset) + 1, set(), *count(body, kind == "class")]
            declared.setdefault(one, []).append(name)
    for name, bare in bares.items():
        if not name.endswith(".cpp"):
            continue
        includes = set(re.findall(r'^#include "([^"]+)"', texts[name], re.MULTILINE))
        for found in DEFINITION.finditer(bare):
            one = found.group(1).rsplit("::", 1)[0]
            home = homes(name, declared[one], includes) if one in declared else None
            if home is not None and defines(bare, found):
                sizes[home, one][1].add(name)
    return sizes


def defines(bare, found):
    """Whether a qualified name is that of a function that is defined here, and not of one that is called."""
    line = bare[bare.rfind("\n", 0, found.start()) + 1:found.start()]
    return not line.startswith((" ", "\t")) and "=" not in line and not line.startswith("return")


def check(root, allowed=None):
    allowed = ALLOWED if allowed is None else allowed
    findings = []
    needed = set()
    for (name, one), (line, files, data, functions) in sorted(measure(root).items()):
        numbers = {"files": len(files), "data members": data, "functions": functions}
        limits = allowed.get(f"{name} {one}", ({}, ""))[0]
        for what, number in numbers.items():
            most = limits.get(what, MOST[what])
            if what in limits:
                needed.add((f"{name} {one}", what))
            if number > most:
                findings.append(f"{name}:{line}: class {one} has {number} {what}, more than {most}; "
                                "divide it into classes that own their data")
            elif what in limits and number < most:
                better = f"write {number}" if number > MOST[what] else "delete it"
                findings.append(f"check_classes.py: {name} {one} has only {number} {what}, {most} are allowed; {better}")
    for entry, (limits, _) in allowed.items():
        findings += [f"check_classes.py: there is no {entry}; delete its {what}"
                     for what in limits if (entry, what) not in needed]
    return findings


if __name__ == "__main__":
    common.report(check(pathlib.Path(sys.argv[1])))
