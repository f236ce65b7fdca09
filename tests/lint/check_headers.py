#!/usr/bin/env python3
"""Every header compiles alone. Public ones are compiled here with both compilers and only the public include directory.
Others are compiled alone by the build if their .cpp includes them first, which is checked; the rest is compiled here.
The build reads common headers precompiled, so a file could do without naming them: what it uses of them must be included,
directly or by a header of ours that it includes.
A header that passed is not compiled again as long as it and all headers of ours that it includes are the same.
check_headers.py ROOT [--cache FOLDER] [compiler flags for the third-party headers...]"""

import concurrent.futures
import hashlib
import os
import pathlib
import re
import subprocess
import sys

import common

STRICT = ["-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wsign-conversion",
          "-Wold-style-cast", "-Werror", "-x", "c++", "-"]
C_ONLY = "include/indurop/module_c.h"
STRICT_C = ["-std=c11", *(word for word in STRICT[1:-3] if word != "-Wold-style-cast"), "-x", "c", "-"]


def strict_of(name):
    return STRICT_C if name == C_ONLY else STRICT


INCLUDE = re.compile(rb'^\s*#\s*include\s*[<"]([^>"]+)', re.MULTILINE)


# What the build precompiles (cmake/IndurOptions.cmake), and what can be seen of its use.
PRECOMPILED = {
    "algorithm": r"std::(ranges::)?((stable_)?sort|find(_if)?|(any|all|none)_of|clamp|transform|copy|count(_if)?|reverse|"
                 r"remove_if|(lower|upper)_bound|equal|fill)\(",
    "array": r"std::array<", "charconv": r"std::(from|to)_chars\(", "chrono": r"std::chrono::", "functional": r"std::function<",
    "map": r"std::(multi)?map<", "memory": r"std::(unique_ptr|shared_ptr|weak_ptr|make_unique|make_shared)<",
    "optional": r"std::(optional<|nullopt)", "span": r"std::span<", "string": r"std::(string\b|to_string\()",
    "string_view": r"std::string_view", "unordered_map": r"std::unordered_map<", "variant": r"std::(variant<|visit\()",
    "vector": r"std::vector<", "fmt/format.h": r"\bfmt::"}
# Standard headers that promise the one used.
ALSO = {"string_view": {"string"}, "fmt/format.h": {"fmt/core.h", "fmt/chrono.h", "fmt/ranges.h", "fmt/color.h", "fmt/ostream.h"}}


def includes_of(root, name, known):
    """All that a file includes, directly or by headers of ours."""
    if name not in known:
        known[name] = set()  # a circle ends here; circles are another lint's
        for target in INCLUDE.findall((root / name).read_bytes()):
            target = target.decode()
            known[name].add(target)
            for path in (root / target, root / "include" / target, root / "tests/support" / target, (root / name).parent / target):
                if path.is_file():
                    known[name] |= includes_of(root, os.path.relpath(path, root), known)
                    break
    return known[name]


def unnamed(root, names):
    """Uses of precompiled headers in files that would not compile without them being precompiled."""
    known = {}
    findings = []
    for name in names:
        code = re.sub(r'//.*|"(?:[^"\\\n]|\\.)*"', "", common.read(root, name))
        for header, use in PRECOMPILED.items():
            found = re.search(use, code)
            if found and not ({header} | ALSO.get(header, set())) & includes_of(root, name, known):
                findings.append(f"{name}: uses {found.group(0).rstrip('<(')} but does not include <{header}>")
    return findings


def fingerprint(root, name, compiler, flags):
    """Hash of the header, of all headers of ours it includes, directly or not, and of the command."""
    digest = hashlib.sha256(" ".join([compiler, *flags, *strict_of(name)]).encode())
    seen, ahead = set(), [root / name]
    while ahead:
        path = ahead.pop()
        if path in seen or not path.is_file():
            continue
        seen.add(path)
        text = path.read_bytes()
        digest.update(text)
        for target in INCLUDE.findall(text):
            ahead += [base / target.decode() for base in (root, root / "include", path.parent)]
    return digest.hexdigest()


def compile_alone(root, name, compiler, flags, cache=None):
    passed = cache / fingerprint(root, name, compiler, flags) if cache else None
    if passed and passed.exists():
        return []
    target = name.removeprefix("include/") if name.startswith("include/") else name
    # Twice: a header must also survive being included again.
    text = f'#include "{target}"\n#include "{target}"\n'
    run = subprocess.run([compiler, *flags, *strict_of(name)], input=text, cwd=root, capture_output=True, text=True, check=False)
    if run.returncode == 0:
        if passed:
            passed.touch()
        return []
    first = next((line for line in run.stderr.splitlines() if "error" in line), "fails")
    return [f"{name}:1: does not compile alone with {compiler}: {first.strip()}"]


def first_include(root, name):
    found = re.search(r'^\s*#\s*include\s*[<"]([^>"]+)', common.read(root, name), re.MULTILINE)
    return found.group(1) if found else None


def check(root, third_party, cache=None):
    work = []
    findings = unnamed(pathlib.Path(root), [name for name in common.cxx_files(root) if not name.startswith(("examples/", "docs/"))])
    for name in common.cxx_files(root):
        if not name.endswith(".h") or name.startswith(("tests/", "examples/", "docs/")):
            continue
        if name.startswith("include/"):
            work += [(root, name, compiler, ["-Iinclude"]) for compiler in ("g++", "clang++")]
        elif (root / name).with_suffix(".cpp").exists():
            source = name.removesuffix(".h") + ".cpp"
            if first_include(root, source) != name:
                findings.append(f'{source}: the first include must be "{name}", to show that it compiles alone')
        else:
            work.append((root, name, "g++", ["-I.", "-Iinclude", *third_party]))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return findings + [finding for found in pool.map(lambda job: compile_alone(*job, cache), work) for finding in found]


if __name__ == "__main__":
    words = sys.argv[2:]
    folder = None
    if words[:1] == ["--cache"]:
        folder = pathlib.Path(words[1])
        folder.mkdir(parents=True, exist_ok=True)
        words = words[2:]
    common.report(check(pathlib.Path(sys.argv[1]), words, folder))
