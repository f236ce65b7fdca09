#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shows Doxygen our plain comments as its own: those above a declaration and those behind it on its line.
doxygen_filter.py HEADER prints the header with as many lines as it has."""

import re
import sys

ABOVE = re.compile(r"^(\s*)// ?(?!namespace\b|NOLINT)(.*)$")
BEHIND = re.compile(r"^(.*[;,{}\w)].*?)  // (?!NOLINT|namespace\b)(.*)$")
VERBATIM = re.compile(r'(`[^`]*`|"[^"]*")')
CASE = re.compile(r"^\s*([\w():]+?):?\s{2,}(\S.*)$")


def escaped(text):
    """Characters that mean something to Doxygen, and `::name`, which it takes for a link."""
    return re.sub(r"(?<![\w:])(?=::)", r"\\", re.sub(r"([\\@<>#$%&])", r"\\\1", text))


def quoted(text):
    """A comment's text as it is. `code` and "text" are shown as such."""
    parts = VERBATIM.split(text)
    for i, part in enumerate(parts):
        if part.startswith("`"):
            parts[i] = f"<code>{escaped(part[1:-1])}</code>"
        elif not part.startswith('"'):
            parts[i] = escaped(part)
    return "".join(parts)


def described(text):
    """One line of a comment above a declaration: what is returned, the cases of a list, examples, prose."""
    case = CASE.match(text)
    if case:
        return f"- <code>{escaped(case.group(1))}</code>: {quoted(case.group(2))}"
    if text.startswith("Returns "):
        return "@return " + quoted(text[len("Returns "):])
    if text.startswith("Errors: "):
        return "@par Errors: " + quoted(text[len("Errors: "):])
    return ("    " if text.startswith("  ") else "") + quoted(text)


def filtered(lines):
    # Line 1 is the SPDX identifier; the comment below it is about the file.
    yield "/// @file"
    for line in lines[1:]:
        above = ABOVE.match(line)
        behind = BEHIND.match(line)
        if above:
            yield f"{above.group(1)}/// {described(above.group(2))}"
        elif behind:
            yield f"{behind.group(1)}  ///< {quoted(behind.group(2))}"
        else:
            yield line


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as header:
        print("\n".join(filtered(header.read().split("\n"))))
