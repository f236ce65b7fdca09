#!/usr/bin/env python3
"""Every header compiles alone. Public ones are compiled here with both compilers and only the public include directory.
Others are compiled alone by the build if their .cpp includes them first, which is checked; the rest is compiled here.
check_headers.py ROOT [compiler flags for the third-party headers...]"""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

import common

STRICT = ["-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wsign-conversion",
          "-Wold-style-cast", "-Werror", "-x", "c++", "-"]


def compile_alone(root, name, compiler, flags):
    target = name.removeprefix("include/") if name.startswith("include/") else name
    # Twice: a header must also survive being included again.
    text = f'#include "{target}"\n#include "{target}"\n'
    run = subprocess.run([compiler, *flags, *STRICT], input=text, cwd=root, capture_output=True, text=True, check=False)
    if run.returncode == 0:
        return []
    first = next((line for line in run.stderr.splitlines() if "error" in line), "fails")
    return [f"{name}:1: does not compile alone with {compiler}: {first.strip()}"]


def first_include(root, name):
    found = re.search(r'^\s*#\s*include\s*[<"]([^>"]+)', common.read(root, name), re.MULTILINE)
    return found.group(1) if found else None


def check(root, third_party):
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
        return findings + [finding for found in pool.map(lambda job: compile_alone(*job), work) for finding in found]


if __name__ == "__main__":
    common.report(check(pathlib.Path(sys.argv[1]), sys.argv[2:]))
