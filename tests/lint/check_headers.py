#!/usr/bin/env python3
"""Every header compiles alone: public ones with both compilers and only the public include directory, all others with
g++. check_headers.py ROOT [compiler flags for the third-party headers...]"""

import concurrent.futures
import os
import pathlib
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


def check(root, third_party):
    work = []
    for name in common.cxx_files(root):
        if not name.endswith(".h") or name.startswith(("tests/", "examples/", "docs/")):
            continue
        if name.startswith("include/"):
            work += [(root, name, compiler, ["-Iinclude"]) for compiler in ("g++", "clang++")]
        else:
            work.append((root, name, "g++", ["-I.", "-Iinclude", *third_party]))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return [finding for found in pool.map(lambda job: compile_alone(*job), work) for finding in found]


if __name__ == "__main__":
    common.report(check(pathlib.Path(sys.argv[1]), sys.argv[2:]))
