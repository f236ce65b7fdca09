#!/usr/bin/env python3
"""Rules that need nothing but the text of the files. check_text.py RULE ROOT"""

import pathlib
import re
import sys

import common

SPDX = "// SPDX-License-Identifier: Apache-2.0"
SPDX_OF_C = "/* SPDX-License-Identifier: Apache-2.0 */"  # headers for programs in C
MAX_LINES = {".h": 400, ".cpp": 400, ".py": 600, ".cmake": 600, ".sh": 600}
CODE = (".h", ".cpp", ".py", ".cmake", ".sh", ".glb", ".xml", ".xsd", ".txt", ".md", ".json", ".yml")
# Printed in the specification; kept as they are.
VERBATIM = ("examples/chapter/", "tests/install/project/", "LICENSE")
# Invisible or left over from another encoding.
JUNK = re.compile("[\u0000-\u0008\u000b\u000c\u000e-\u001f\u007f-\u00a0\u00ad\u200b-\u200f\u2028-\u202f\u2060-\u206f\ufeff\ufffd]")
WORK_LEFT = re.compile(r"\b(TODO|FIXME|XXX|HACK)\b(?!\(#\d+\))")


def own_text(root):
    for name in common.project_files(root):
        if not common.is_data(name) and (name.endswith(CODE) or name in ("Makefile", "LICENSE")):
            yield name, common.read(root, name)


def spdx(root):
    for name in common.cxx_files(root):
        if name.startswith(VERBATIM):
            continue
        lines = common.read(root, name).split("\n")
        if lines[0] not in (SPDX, SPDX_OF_C):
            yield f"{name}:1: first line must be '{SPDX}'"
        elif (len(lines) < 2 or not re.match(r"(//|/\*) \S", lines[1])) and not (
                name.endswith("_test.cpp")
                or name.endswith(".cpp") and (pathlib.Path(root) / name).with_suffix(".h").exists()):
            yield f"{name}:2: say in one to four lines of comment what this file is for"


def todo(root):
    for name, text in own_text(root):
        if name.startswith("tests/lint/"):
            continue
        for number, line in enumerate(text.split("\n"), 1):
            if WORK_LEFT.search(line):
                yield f"{name}:{number}: unfinished work without an issue; write TODO(#<issue>)"


def disabled(root):
    for name, text in own_text(root):
        if not name.startswith("tests/") or name.startswith("tests/lint/"):
            continue
        for number, line in enumerate(text.split("\n"), 1):
            if re.search(r"\bDISABLED_|\bDISABLED\s+(TRUE|ON|1)\b", line) and not re.search(r"\(#\d+\)|issue #\d+", line):
                yield f"{name}:{number}: disabled test without an issue number on the line"


def length(root):
    for name, text in own_text(root):
        lines = text.count("\n")
        most = MAX_LINES.get(pathlib.PurePath(name).suffix, lines)
        if lines > most:
            yield f"{name}:{lines}: longer than {most} lines; split it by idea"


def names(root):
    """A test is called by what it shows, in words: Readers_never_see_a_mixture."""
    for name in common.cxx_files(root):
        text = common.read(root, name) if name.startswith("tests/") else ""
        for found in re.finditer(r"^\s*(?:TYPED_)?TEST(?:_F|_P)?\(\s*\w+,\s*(\w+)\)", text, re.MULTILINE):
            if not re.fullmatch(r"[A-Z][a-z]*|[A-Z][A-Za-z0-9]*(_[A-Za-z0-9]+)+", found.group(1)):
                line = text.count("\n", 0, found.start(1)) + 1
                yield f"{name}:{line}: {found.group(1)}: a test is named by what it shows, as in Readers_never_see_a_mixture"


def characters(root):
    for name, text in own_text(root):
        if name.startswith(VERBATIM):
            continue
        if text and not text.endswith("\n"):
            yield f"{name}:{text.count(chr(10)) + 1}: no newline at the end of the file"
        for number, line in enumerate(text.split("\n"), 1):
            if JUNK.search(line) or "\r" in line:
                yield f"{name}:{number}: invisible or broken character"
            if line != line.rstrip():
                yield f"{name}:{number}: white space at the end of the line"
            # Text for the user may hold any character; names and comments of code may not.
            bare = re.sub(r'"(\\.|[^"\\])*"', '""', line)
            if name.endswith((".h", ".cpp", ".cmake")) and not bare.isascii() and 'R"' not in text:
                yield f"{name}:{number}: only ASCII outside of string literals"


def prose(root):
    """Prose of Markdown ends before column 120. Not meant: tables, code, what has no place to break, generated pages."""
    for name, text in own_text(root):
        if not name.endswith(".md") or name == "docs/options.md":
            continue
        in_code = False
        for number, line in enumerate(text.split("\n"), 1):
            in_code ^= line.lstrip().startswith("```")
            words_only = re.sub(r"`[^`]*`|\]\([^)]*\)", "x", line).strip()
            if len(line) >= 120 and not in_code and not line.lstrip().startswith("|") and " " in words_only:
                yield f"{name}:{number}: {len(line)} columns of prose; end the line before column 120"


def changelog(root):
    version = re.search(r"^project\(\S+ VERSION ([0-9.]+)", common.read(root, "CMakeLists.txt"), re.MULTILINE)
    top = re.search(r"^## \[?([0-9.]+)", common.read(root, "CHANGELOG.md"), re.MULTILINE)
    if not version or not top or version.group(1) != top.group(1):
        yield (f"CHANGELOG.md:1: newest entry is {top.group(1) if top else 'missing'}, "
               f"the project is {version.group(1) if version else 'without version'}")


# What another kernel has not, or has in another way: the rooms have core/rt/ for it.
BELOW_RT = re.compile(r"\bpthread_(?:mutex|cond|rwlock|spin|barrier)\w*|\bsem_(?:t\b|\w+\s*\()|\b(?:flock|membarrier)\s*\(|"
                      r"\bSYS_(?:membarrier|futex|tkill)|\bFUTEX_|\bF_OFD_|<(?:semaphore|sys/file|linux/\w+)\.h>")

# Throws if the stream cannot be written, which ends a node whose log is on a full disk.
THROWING_PRINT = re.compile(r"\bfmt::print\(")


def border(root):
    for name in common.cxx_files(root):
        if name.startswith(("tests/", "examples/")):
            continue
        for number, line in enumerate(common.read(root, name).split("\n"), 1):
            bare = re.sub(r'"(\\.|[^"\\])*"', '""', line)
            found = BELOW_RT.search(bare)
            if found and not name.startswith("core/rt/"):
                yield f"{name}:{number}: {found.group(0)} is for core/rt/ only; use what core/rt/ offers, or add it there for both systems"
            if THROWING_PRINT.search(bare.split("//")[0]):
                yield f"{name}:{number}: fmt::print throws if the stream cannot be written; use base::print of core/base/print.h"


def retired_words():
    """Pairs of a pattern and what to write instead."""
    for line in (pathlib.Path(__file__).parent / "retired_words.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            pattern, instead = line.split("  ", 1)
            yield re.compile(pattern, re.IGNORECASE), instead


# Rooms whose names and messages use the terms, too, and pages that do not.
PLAIN_ROOMS = ("include/indurop/", "core/", "glb2idl/", "scheduler/", "config/", "store/", "history/", "control/io/",
               "control/plc/", "control/robot/", "node/", "network/", "deploy/", "tools/", "examples/", "tests/")
OPEN_PAGES = ("docs/words.md", "docs/options.md", "tests/data/")
# Names in files or messages that other releases read, and what they are called by in the code that writes them.
FIXED_NAMES = re.compile(r"\bindurop/told\b|indurop::Told|struct Told|external/wish|`Wish`|\bindurop_wire_Wish\w*|\bbool(ean)? anew\b|\b(run|old|older)(\.|->)anew\b|"
                         r"\bfile_beside_config\b|alarms-beside-the-loop|\"nobody\",|\"owner\"\], \"nobody\"|\bNobody\b|"
                         r"nobody@example\.com\">nobody<")


# Files in which all comments, names and messages use the terms, and the beginning of a comment in them and in C++.
HASH_SCRIPTS = (".py", ".sh", ".cmake", "CMakeLists.txt", "Makefile")
SCRIPTS = HASH_SCRIPTS + (".js", ".mjs", ".ts", ".tsx", ".html", ".css", ".glb", ".st")
COMMENT = re.compile(r"(?<!:)(?://|/\*|\(\*|<!--) ")
COMMENT_OF_HASH = re.compile(r'(?<!["\'])# |"""')
# They quote the retired words.
WORD_LISTS = ("tests/lint/check_text.py", "tests/lint/selftest.py")


def words_of_code(code):
    """An identifier as its words: `let_go` and `LetGo` are 'let go'."""
    return re.sub(r"_+|(?<=[a-z])(?=[A-Z])", " ", code)


def words(root):
    """Comments, without what is quoted in them, names, messages and pages use the terms of docs/words.md."""
    retired = list(retired_words())
    for name in common.project_files(root):
        is_script = name.endswith(SCRIPTS) and name not in WORD_LISTS
        is_code = is_script or name.endswith(common.CXX)
        is_page = name.endswith(".md") and not name.startswith(OPEN_PAGES)
        if not is_code and not is_page or is_code and (common.is_data(name) or name.startswith(VERBATIM)):
            continue
        is_plain = is_script or name.startswith(PLAIN_ROOMS)
        begin_of_comment = COMMENT_OF_HASH if name.endswith(HASH_SCRIPTS) else COMMENT
        for number, line in enumerate(common.read(root, name).split("\n"), 1):
            text = line = line if is_script else FIXED_NAMES.sub("", line)
            if is_code:
                code, *comment = begin_of_comment.split(line, maxsplit=1)
                text = (words_of_code(code) if is_plain else "") + re.sub(r"`[^`]*`|\"[^\"]*\"", "", "".join(comment))
            for pattern, instead in retired:
                if found := pattern.search(text):
                    yield f"{name}:{number}: '{found.group(0)}' is retired: {instead}"


RULES = {rule.__name__: rule for rule in (spdx, todo, disabled, length, prose, names, characters, border, changelog, words)}

if __name__ == "__main__":
    common.report(list(RULES[sys.argv[1]](pathlib.Path(sys.argv[2]))))
