"""Shared by the lint scripts: which files belong to the project, and how a finding is printed."""

import os
import pathlib
import re
import subprocess
import sys

CXX = (".h", ".cpp")
# The path that an #include names, in the bytes of a file.
INCLUDE = re.compile(rb'^\s*#\s*include\s*[<"]([^>"]+)', re.MULTILINE)
# Text that is data for tests, not ours to format: expected output, malformed input.
DATA = ("tests/golden/", "tests/fuzz/corpus/", "tests/data/", "docs/design/generated_header_example.h")


def project_files(root):
    """Paths relative to root, with '/', of all files git tracks or would track; without git, of all files."""
    root = pathlib.Path(root)
    git = subprocess.run(
        ["git", "-c", "safe.directory=*", "-C", str(root), "ls-files", "-z", "-co", "--exclude-standard"],
        capture_output=True, check=False)
    if git.returncode == 0 and (root / ".git").exists():
        names = git.stdout.decode().split("\0")
        return sorted(name for name in names if name and (root / name).is_file())
    found = []
    for folder, folders, names in os.walk(root):
        folders[:] = [f for f in folders if f != ".git" and not f.startswith("build")]
        found += [(pathlib.Path(folder) / name).relative_to(root).as_posix() for name in names]
    return sorted(found)


def is_data(name):
    return name.startswith(DATA)


def cxx_files(root):
    return [name for name in project_files(root) if name.endswith(CXX) and not is_data(name)]


def read(root, name):
    return (pathlib.Path(root) / name).read_bytes().decode("utf-8", errors="replace")


def report(findings):
    """Prints the findings and ends the program: 0 if there are none, else 1."""
    for finding in findings:
        print(finding, file=sys.stderr)
    print(f"{len(findings)} finding(s)")
    sys.exit(1 if findings else 0)
