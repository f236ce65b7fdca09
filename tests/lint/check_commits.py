#!/usr/bin/env python3
"""Commit subjects are `room: imperative`, of at most 72 characters, for commits made since the rule exists.
check_commits.py ROOT. Exit code 77 if this is no clone that reaches back that far."""

import re
import subprocess
import sys

import common

LAST_WITHOUT_RULE = "b016ddaf886325485d95eb3e1bf39069eb8569f7"
LONGEST = 72
ROOM = re.compile(r"[a-z0-9][a-z0-9_./-]*(, [a-z0-9][a-z0-9_./-]*)*: (?P<act>\S.*)")
# Verbs whose imperative ends like another form.
IMPERATIVES = {"access", "address", "bring", "compress", "cross", "discuss", "embed", "exceed", "express", "feed",
               "focus", "guess", "miss", "need", "pass", "ping", "press", "process", "shed", "speed", "string", "suppress"}


def findings(subject):
    if len(subject) > LONGEST:
        yield f"has {len(subject)} characters, the limit is {LONGEST}"
    match = ROOM.fullmatch(subject)
    if match is None:
        yield "is not 'room: imperative', as in 'robot: wait for drives to switch off before enabling'"
        return
    verb = match["act"].split()[0]
    if not re.fullmatch(r"[a-z][a-z-]*", verb):
        yield f"begins with '{verb}' after the room, not with a verb in lower case"
    elif verb not in IMPERATIVES and verb.endswith(("s", "ed", "ing")):
        yield f"begins with '{verb}' after the room: use the imperative"
    if subject.endswith("."):
        yield "ends with a full stop"


def check(commits):
    """commits: (short hash, subject) of each."""
    return [f"{commit}: '{subject}' {what}" for commit, subject in commits for what in findings(subject)]


def commits_of(root):
    """None if the commit before the rule is not there (a shallow clone, no git)."""
    git = ["git", "-c", "safe.directory=*", "-C", str(root)]
    log = subprocess.run([*git, "log", "--no-merges", "--format=%h%x00%s", f"{LAST_WITHOUT_RULE}..HEAD"],
                         capture_output=True, text=True, check=False)
    if log.returncode != 0:
        return None
    return [tuple(line.split("\0", 1)) for line in log.stdout.splitlines()]


if __name__ == "__main__":
    made = commits_of(sys.argv[1])
    if made is None:
        print("skipped: this clone does not reach back to the first commit that is checked")
        sys.exit(77)
    common.report(check(made))
