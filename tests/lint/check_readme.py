#!/usr/bin/env python3
"""What the documentation tells people to type exists, its links lead somewhere, and so do the files it names in code
of this tree, `store/vars/store.h`, or `store/vars/store` for short, and tests, `Suite.Shows_something`.
check_readme.py ROOT [INDUROP]
INDUROP: the built program, whose --help must know every verb shown."""

import functools
import pathlib
import re
import subprocess
import sys

import common

FENCE = re.compile(r"^```(\w*)[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)
NAMED_FILE = re.compile(r"`((?:[a-z0-9_]+/)+[\w.-]*)`")
NAMED_TEST = re.compile(r"`([A-Z]\w+\.[A-Z][a-z0-9]*_\w+)`")
TEST = re.compile(r"^TEST\w*\(\s*(\w+),\s*(\w+)\)", re.MULTILINE)
LINK = re.compile(r"\]\(([^)#\s]*)(?:#([^)\s]*))?\)")


def commands(text):
    """Typed lines: those after '$ ' in console blocks, every line of sh blocks."""
    for language, block in FENCE.findall(text):
        if language in ("console", "sh", "bash", "shell"):
            for line in block.splitlines():
                if line.startswith("$ "):
                    yield line[2:]
                elif language != "console" and line and not line.startswith("#"):
                    yield line


def missing_files(root, name, text, files):
    """Paths below a folder of this tree, from the top or from the page's own folder, that lead nowhere."""
    folders = {parent.as_posix() for file in files for parent in pathlib.PurePosixPath(file).parents}
    own = pathlib.PurePosixPath(name).parent
    for path in NAMED_FILE.findall(text):
        for start in (pathlib.PurePosixPath(), own, pathlib.PurePosixPath("include")):
            full = (start / path).as_posix()
            if full in folders or any(full + ending in files for ending in ("", ".h", ".cpp")):
                break
        else:
            if any((start / path.split("/", 1)[0]).as_posix() in folders for start in (pathlib.PurePosixPath(), own)):
                yield f"{name}: names the missing file {path}"


@functools.cache
def anchors(page):
    """The headings of a page as links name them, in small letters, without punctuation, spaces as hyphens; and its ids."""
    shown = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", FENCE.sub("", text := page.read_text(encoding="utf-8")))
    return {re.sub(r"[^\w -]", "", heading.lower()).strip().replace(" ", "-")
            for heading in re.findall(r"^#+ (.*)", shown, re.MULTILINE)} | set(re.findall(r'<a id="([^"]+)"', text))


def broken_links(root, name, text):
    for target, anchor in LINK.findall(text):
        if "://" in target or not (target or anchor):
            continue
        page = (root / name).parent / target if target else root / name
        if not page.exists():
            yield f"{name}: link to missing file {target}"
        elif anchor and page.suffix == ".md" and anchor not in anchors(page):
            yield f"{name}: {target or 'this page'} has no heading #{anchor}"


def tests_of(root, files):
    return {".".join(names) for file in files if file.startswith("tests/") and file.endswith(".cpp")
            for names in TEST.findall(common.read(root, file))}


def check(root, program):
    make_targets = set(re.findall(r"^([a-z][a-z-]*(?: [a-z-]+)*):", common.read(root, "Makefile"), re.MULTILINE))
    make_targets = {word for line in make_targets for word in line.split()}
    verbs = None
    if program:
        verbs = subprocess.run([program, "--help"], capture_output=True, text=True, check=False).stdout
    findings = []
    files = set(common.project_files(root))
    tests = tests_of(root, files)
    for name in sorted(files):
        if not name.endswith(".md"):
            continue
        text = common.read(root, name)
        findings += missing_files(root, name, text, files)
        findings += [f"{name}: names the missing test {test}" for test in NAMED_TEST.findall(text) if test not in tests]
        findings += broken_links(root, name, text)
        for command in commands(text):
            for part in re.split(r"\s*(?:&&|;|\|)\s*", command):
                words = part.split()
                # Inside a project of the user's own (`indurop new`) make means that project's Makefile.
                if words[:1] == ["make"] and name == "README.md":
                    findings += [f"{name}: `{part}`: no such target in Makefile"
                                 for word in words[1:] if "=" not in word and word[0] != "-" and word not in make_targets]
                elif words[:1] and words[0].rsplit("/", 1)[-1] == "indurop" and verbs is not None and len(words) > 1:
                    if words[1][0] != "-" and not re.search(rf"^\s+{re.escape(words[1])}\b", verbs, re.MULTILINE):
                        findings.append(f"{name}: `{part}`: indurop has no verb {words[1]}")
                elif words[:1] and words[0].startswith(("examples/", ".ci/", "./examples/", "./.ci/")):
                    if not (root / words[0]).exists():
                        findings.append(f"{name}: `{part}`: no such file")
    return findings


if __name__ == "__main__":
    common.report(check(pathlib.Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else None))
