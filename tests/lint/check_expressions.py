#!/usr/bin/env python3
"""Conditional expressions (`a ? b : c`) choose a value and nothing else: none is a statement on its own, none is assigned to,
none is nested three deep. By a scan of the text: nothing is compiled. check_expressions.py ROOT"""

import pathlib
import re
import sys

import common
from check_functions import blank

MAX_DEPTH = 2
MARK = re.compile(r"[?:,()\[\]]")
ASSIGNS = re.compile(r"\s*(?:[-+*/%&|^]|<<|>>)?=(?!=)")
VALUE_USED = re.compile(r"\s*(?:else\s+)?(?:return|co_return|co_yield|throw|static_assert|using|case)\b")


class Expression:
    """The conditional expressions of one statement: how deep they are nested, and where one is assigned to."""

    def __init__(self, text):
        self.text = text
        self.marks = list(MARK.finditer(text))
        self.next = 0
        self.depth = 0
        self.targets = []
        self.open = 0
        self.outside = False  # one stands outside of all brackets
        while self.next < len(self.marks):
            self.part(False)
            self.next += 1

    def part(self, in_middle):
        """Depth of what begins at the next mark and ends before a comma, a closing bracket or, between `?` and `:`, a colon."""
        depth = 0
        while self.next < len(self.marks):
            mark = self.marks[self.next].group()
            if mark in "([":
                depth = max(depth, self.brackets())
            elif mark == "?":
                self.outside |= self.open == 0
                self.next += 1
                middle = self.part(True)
                self.next += 1  # the colon
                depth = 1 + max(depth, middle, self.part(in_middle))
                self.depth = max(self.depth, depth)
                return depth
            elif mark in ",)]" or in_middle:
                return depth
            else:
                self.next += 1
        return depth

    def brackets(self):
        opening = self.marks[self.next]
        self.next += 1
        self.open += 1
        first = self.part(False)
        depth, alone = first, True
        while self.next < len(self.marks) and self.marks[self.next].group() == ",":
            self.next += 1
            alone = False
            depth = max(depth, self.part(False))
        if self.next < len(self.marks):
            end = self.marks[self.next].end()
            called = re.search(r"[\w>\])]\s*$", self.text[:opening.start()])
            if first and alone and not called and ASSIGNS.match(self.text, end):
                self.targets.append(opening.start())
            self.next += 1
        self.open -= 1
        return depth


def statements(bare):
    """Start, text and end mark of what stands between braces and semicolons."""
    start = 0
    for found in re.finditer(r"[;{}]", bare):
        if "?" in bare[start:found.start()]:
            yield start, bare[start:found.start()], found.group()
        start = found.end()


def check_text(name, text):
    bare = blank(text).replace("::", "..")
    for start, statement, end in statements(bare):
        expression = Expression(statement)
        line = bare.count("\n", 0, start + len(statement) - len(statement.lstrip())) + 1
        if expression.depth > MAX_DEPTH:
            yield f"{name}:{line}: conditional expressions nested {expression.depth} deep; use if, a table or a function"
        if expression.targets:
            yield f"{name}:{line}: assigns to a conditional expression; use if and else"
        bracketed = re.sub(r"\([^()]*\)", "", statement)
        while bracketed != (bracketed := re.sub(r"\([^()]*\)", "", bracketed)):
            pass
        whole = end == ";" and bracketed.count("(") == bracketed.count(")") and re.match(r"\s*[\w(*]", statement)
        if whole and expression.outside and not re.search("=|<<", bracketed) and not VALUE_USED.match(statement):
            yield f"{name}:{line}: a conditional expression as a statement; use if and else"


def check(root):
    return [finding for name in common.cxx_files(root) for finding in check_text(name, common.read(root, name))]


if __name__ == "__main__":
    common.report(check(pathlib.Path(sys.argv[1])))
