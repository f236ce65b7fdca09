#!/usr/bin/env python3
"""Every header compiles alone. Public ones are compiled here with both compilers and only the public include directory.
Others are compiled alone by the build if their .cpp includes them first, which is checked; the rest is compiled here.
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
        for target in common.INCLUDE.findall(text):
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
    findings = []
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
