#!/usr/bin/env python3
"""Every C++ file is as clang-format 14 writes it. check_format.py ROOT [--fix]"""

import pathlib
import subprocess
import sys

import common


def check(root):
    files = common.cxx_files(root)
    findings = []
    for start in range(0, len(files), 50):
        run = subprocess.run(["clang-format", "--dry-run", "-Werror", "--style=file", *files[start:start + 50]],
                             cwd=root, capture_output=True, text=True, check=False)
        findings += [line for line in run.stderr.splitlines() if ": error:" in line]
        if run.returncode != 0 and not run.stderr:
            findings.append(f"clang-format failed with code {run.returncode}")
    return findings


if __name__ == "__main__":
    if "--fix" in sys.argv:
        subprocess.run(["clang-format", "-i", "--style=file", *common.cxx_files(sys.argv[1])], cwd=sys.argv[1], check=True)
    found = check(pathlib.Path(sys.argv[1]))
    if found:
        print("run: make format", file=sys.stderr)
    common.report(found)
