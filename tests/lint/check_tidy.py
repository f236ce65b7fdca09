#!/usr/bin/env python3
"""clang-tidy over our sources, remembering the findings of a file by the hash of everything that went in.
check_tidy.py families ROOT | check_tidy.py run ROOT BUILD [path prefix...] | check_tidy.py changed ROOT BUILD
changed: the .cpp files that differ from where the branch left origin/main (on main itself: from the commit before)."""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

import common

MAX_CHANGED = 6  # files that `changed` checks, so that it stays below a minute; `make tidy` checks all
FAMILIES = ("bugprone", "cert", "clang-analyzer", "concurrency", "cppcoreguidelines", "misc", "modernize", "performance",
            "portability", "readability")


def families(root, file="core/rt/clock.cpp"):
    """A family whose name is misspelt in .clang-tidy is silently off: ask clang-tidy what is on."""
    listed = subprocess.run(["clang-tidy", "--list-checks", str(root / file), "--"], cwd=root, capture_output=True,
                            text=True, check=False).stdout
    return [f".clang-tidy: no check of the family {family}-* is active"
            for family in FAMILIES if not re.search(rf"^\s+{family}-", listed, re.MULTILINE)]


def cache_folder(build):
    base = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    for folder in (pathlib.Path(base) / "indurop-tidy", pathlib.Path(build) / "tidy-cache"):
        try:
            folder.mkdir(parents=True, exist_ok=True)
            if os.access(folder, os.W_OK):
                return folder
        except OSError:
            pass
    return None


def clang_arguments(entry):
    words = shlex.split(entry["command"])
    compiler = next(place for place, word in enumerate(words) if re.search(r"(c|g|clang)\+\+[-.0-9]*$", word))
    drop_next = False
    kept = []
    for word in words[compiler + 1:]:
        if drop_next:
            drop_next = False
        elif word in ("-o", "-include"):
            drop_next = True  # what is included so is g++'s precompiled header
        elif word not in ("-c", "-Winvalid-pch") and not word.endswith((".cpp", ".cxx")) and word not in ("-fno-gnu-unique",):
            kept.append(word)
    return kept


def fingerprint(root, entry, arguments, common_part):
    """Hash of the file, of every header of ours it includes, of the command and of the configuration; None if unknown."""
    run = subprocess.run(["clang++", *arguments, "-Wno-everything", "-MM", entry["file"]], cwd=entry["directory"],
                         capture_output=True, text=True, check=False)
    if run.returncode != 0:
        return None
    digest = hashlib.sha256(common_part)
    digest.update(" ".join(arguments).replace(str(root), "").encode())
    for name in run.stdout.split(":", 1)[1].replace("\\\n", " ").split():
        path = pathlib.Path(entry["directory"]) / name
        digest.update(path.read_bytes())
    return digest.hexdigest()


def configuration(root, file):
    """What the .clang-tidy files of its folder and of those above say."""
    folders = pathlib.Path(file).resolve().relative_to(root).parents
    return b"".join((root / folder / ".clang-tidy").read_bytes() for folder in folders
                    if (root / folder / ".clang-tidy").exists())


def tidy_one(root, build, entry, folder, common_part):
    arguments = clang_arguments(entry)
    key = fingerprint(root, entry, arguments, common_part) if folder else None
    if key and (folder / key).exists():
        return (folder / key).read_text().splitlines()
    run = subprocess.run(["clang-tidy", "--quiet", entry["file"], "--", *arguments], cwd=entry["directory"],
                         capture_output=True, text=True, check=False)
    findings = [line.replace(f"{root}/", "") for line in run.stdout.splitlines() if re.search(r": (error|warning):", line)]
    if run.returncode != 0 and not findings:
        return [f"{entry['file']}: clang-tidy failed: {(run.stderr or run.stdout).strip()[:500]}"]
    if key:
        # Renamed into place: another run never reads half of it.
        part = folder / f"{key}.{os.getpid()}"
        part.write_text("\n".join(findings))
        part.rename(folder / key)
    return findings


def git(root, *words):
    run = subprocess.run(["git", "-c", "safe.directory=*", "-C", str(root), *words], capture_output=True, text=True, check=False)
    return run.stdout.split("\n")[:-1] if run.returncode == 0 else None


def changed(root):
    """The .cpp files of ours that are new or different, latest first, and why there are none to ask about."""
    head = git(root, "rev-parse", "HEAD")
    if not head:
        return [], "no git here"
    base = git(root, "merge-base", "origin/main", "HEAD")
    if not base or base == head:
        base = git(root, "rev-parse", "--verify", "-q", "HEAD~1")
    if not base:
        return [], "no older commit here"
    names = set(git(root, "diff", "--name-only", base[0]) or []) | set(git(root, "ls-files", "-o", "--exclude-standard") or [])
    files = [name for name in common.cxx_files(root) if name in names and name.endswith(".cpp")]
    return sorted(files, key=lambda name: -(root / name).stat().st_mtime), "no .cpp file is changed"


def run_changed(root, build):
    files, reason = changed(root)
    if not files:
        print(f"skipped: {reason}")
        return []
    if len(files) > MAX_CHANGED:
        print(f"the {MAX_CHANGED} latest of {len(files)} changed files; `make tidy` checks all")
    return run_all(root, build, [], set(files[:MAX_CHANGED]))


def compiled(build):
    """What is compiled; a file that is compiled together with others has an entry of its own."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = pathlib.Path(entry["file"])
        if path.parent.name == "Unity" and path.exists():
            for name in re.findall(r'^#include "(.+)"$', path.read_text(), re.MULTILINE):
                yield {**entry, "file": name}
        else:
            yield entry


def run_all(root, build, prefixes, only=None):
    ours = {str(root / name): name for name in common.cxx_files(root) if only is None or name in only}
    entries = {}
    for entry in compiled(build):
        name = ours.get(str(pathlib.Path(entry["file"]).resolve()))
        if name and (not prefixes or name.startswith(tuple(prefixes))):
            entries.setdefault(name, entry)
    if not entries and only is None:
        return [f"{build}/compile_commands.json: names none of our sources"]
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout
    folder = cache_folder(build)
    # Large files first, so that the last minutes are not one file on one core.
    order = sorted(entries.values(), key=lambda entry: -os.path.getsize(entry["file"]))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = pool.map(lambda entry: tidy_one(root, build, entry, folder, version + configuration(root, entry["file"])), order)
        findings = sorted({finding for found in results for finding in found})
    print(f"{len(entries)} files")
    return findings


if __name__ == "__main__":
    source = pathlib.Path(sys.argv[2]).resolve()
    if sys.argv[1] == "families":
        common.report(families(source))
    if sys.argv[1] == "changed":
        common.report(run_changed(source, pathlib.Path(sys.argv[3]).resolve()))
    common.report(run_all(source, pathlib.Path(sys.argv[3]).resolve(), sys.argv[4:]))
