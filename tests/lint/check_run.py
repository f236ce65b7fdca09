#!/usr/bin/env python3
"""What a run of ctest passes over in silence: tests that were skipped, and tests that passed at the second try only. Says
again, at the end of a long output, why tests failed. Where all passed, they leave no nodes in shared memory.
check_run.py JUNIT LOG BEFORE; BEFORE lists /dev/shm before the tests. Where $CI is set, a test skipped without a line in
may_skip.txt fails, and so do more than two retried, and shared memory that is left."""

import fnmatch
import os
import pathlib
import re
import sys
import xml.etree.ElementTree

import common

MAX_RETRIED = 2
LAST_LINES = 40
RESULT = re.compile(r"^\s*(?:\d+/\d+ )?Test\s+#\d+: (.*?) \.*\s*(?:\*\*\*)?(\w[\w ]*?)\s+[\d.]+ sec", re.MULTILINE)


def last_lines(text):
    """Of what a test printed. Of the frames of a Python traceback only the last one, so that the error is read first."""
    lines = text.strip().splitlines()[-LAST_LINES:]
    frames = [i for i, line in enumerate(lines) if line.startswith('  File "')]
    return lines[:frames[0]] + lines[frames[-1]:] if frames else lines


def skipped(junit):
    """Name and reason of each test that was skipped."""
    for case in xml.etree.ElementTree.parse(junit).iter("testcase"):
        if case.find("skipped") is not None:
            said = [line.strip() for line in (case.findtext("system-out") or "").splitlines() if line.strip()]
            # GoogleTest says it before it says SKIPPED; a script in its last line.
            marks = [i for i, line in enumerate(said) if "SKIPPED" in line]
            yield case.get("name"), said[max(marks[0] - 1, 0)] if marks else (said or ["no reason given"])[-1]


def failed(junit):
    """Name and last lines of each test that failed, the reason before them where one is known."""
    for case in xml.etree.ElementTree.parse(junit).iter("testcase"):
        failure = case.find("failure")
        if failure is not None:
            yield case.get("name"), [failure.get("message") or "", *last_lines(case.findtext("system-out") or "")]


def results(log):
    """Results of each test in the order they came."""
    found = {}
    for name, result in RESULT.findall(log):
        found.setdefault(name, []).append(result)
    return found


def first_failure(log, name):
    """Last lines of what the test printed at its first try, which failed."""
    for found in RESULT.finditer(log):
        if found.group(1) == name and found.group(2) != "Passed":
            printed = re.split(r"^ *(?:Start +\d+:|(?:\d+/\d+ )?Test +#\d+:)", log[found.end():], maxsplit=1, flags=re.MULTILINE)[0]
            return last_lines(printed)
    return []


def retried(log):
    return sorted(name for name, all_of_it in results(log).items() if len(all_of_it) > 1 and all_of_it[-1] == "Passed")


def not_run(log):
    """Tests whose program could not be started. ctest counts them as failed, but names them in no list."""
    return sorted(name for name, all_of_it in results(log).items() if all_of_it[-1] == "Not Run")


def allowed(file):
    """Patterns of tests that may be skipped; each has its reason on the line."""
    lines = [line.split("  ", 1) for line in file.read_text().splitlines() if line.strip() and line[0] != "#"]
    return [words[0] for words in lines if len(words) == 2 and words[1].strip()]


def left(before, shared_memory=pathlib.Path("/dev/shm")):
    """Nodes that are new there and do not run."""
    found = []
    for lock in sorted(shared_memory.glob("indurop.*.lock")):
        runs = re.match(rb"\d+", lock.read_bytes())
        if lock.name not in before and not (runs and os.path.exists(f"/proc/{int(runs[0])}")):
            found.append(lock.name.removeprefix("indurop.").removesuffix(".lock"))
    return found


def check(junit, log, patterns):
    findings = [f"{name}: skipped ({reason}) and not in may_skip.txt" for name, reason in skipped(junit)
                if not any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)]
    again = retried(log)
    if len(again) > MAX_RETRIED:
        findings.append(f"{len(again)} tests failed at the first try, {MAX_RETRIED} may: {', '.join(again)}")
    return findings


def main():
    junit, log = sys.argv[1], pathlib.Path(sys.argv[2]).read_text(errors="replace")
    for name, reason in skipped(junit):
        print(f"skipped: {name}: {reason}")
    for name in retried(log):
        print(f"passed at the second try only: {name}:", *first_failure(log, name), sep="\n  | ")
    for name in not_run(log):
        print(f"could not be started: {name}")
    for name, lines in failed(junit):
        print(f"did not pass: {name}:", *lines, sep="\n  | ")
    findings = check(junit, log, allowed(pathlib.Path(__file__).with_name("may_skip.txt")))
    if not retried(log) and not list(failed(junit)):
        remaining = left(pathlib.Path(sys.argv[3]).read_text().split())
        findings += [f"node {node} was left in shared memory: its test has to remove it" for node in remaining]
    if os.environ.get("CI"):
        common.report(findings)


if __name__ == "__main__":
    main()
