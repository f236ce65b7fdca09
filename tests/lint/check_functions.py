#!/usr/bin/env python3
"""No function is longer than 60 lines, by a scan of the text: nothing is compiled. A list that cannot be shorter carries, on
the line above it, a comment that says so: `// Long: <reason>`. check_functions.py ROOT"""

import pathlib
import re
import sys

import common

MAX_LINES = 60
TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"([^()\\ \n]{0,16})\(.*?\)\1"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'|^[ \t]*#(?:\\\n|[^\n])*", re.DOTALL | re.MULTILINE)
SCOPE = re.compile(r"^\s*(?:template\b.*>\s*)?(?:inline\s+)?(?:(?:namespace|extern|union|enum)\b|(?:class|struct)\b(?!.*\)\s*$))",
                   re.DOTALL)


def blank(text):
    """The text without comments, strings and preprocessor lines, each line where it was."""
    return TOKEN.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)


def functions(text):
    """Name, first and last line of each function; one inside another belongs to the outer one."""
    bare = blank(text)
    depth = 0
    inside = None  # depth, name and first line of the function the scan is in
    start = 0  # of the declaration that a brace would belong to
    round_open = 0
    for found in re.finditer(r"[{};()]", bare):
        mark = found.group()
        if mark in "()":
            round_open += 1 if mark == "(" else -1
        elif mark == "{":
            head = bare[start:found.start()]
            if inside is None and round_open == 0 and "(" in head and not SCOPE.match(head):
                named = re.search(r"([\w:~]+|operator\S+)\s*\(", head)
                first = start + len(head) - len(head.lstrip())
                inside = (depth, named.group(1) if named else "lambda", first)
            depth += 1
            if inside is None:
                start = found.end()
        elif mark == "}":
            depth -= 1
            if inside is not None and depth == inside[0]:
                yield inside[1], bare.count("\n", 0, inside[2]) + 1, bare.count("\n", 0, found.start()) + 1
                inside = None
            if inside is None:
                start = found.end()
        elif inside is None and round_open == 0:
            start = found.end()


def check(root):
    findings = []
    for name in common.cxx_files(root):
        text = common.read(root, name)
        lines = text.split("\n")
        for function, first, last in functions(text):
            excused = first > 1 and re.search(r"// Long: \S", lines[first - 2])
            if last - first + 1 > MAX_LINES and not excused:
                findings.append(f"{name}:{first}: {function} has {last - first + 1} lines, more than {MAX_LINES}; "
                                "divide it, or say above it why not: // Long: <reason>")
    return findings


if __name__ == "__main__":
    common.report(check(pathlib.Path(sys.argv[1])))
