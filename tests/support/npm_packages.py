# SPDX-License-Identifier: Apache-2.0
"""Packages of npm that tests use as judges. Without npm or its registry the test is skipped."""

import shutil
import subprocess
import sys

SKIPPED = 77
# What npm says where its registry cannot be reached.
NO_NETWORK = ("ENOTFOUND", "EAI_AGAIN", "ECONNREFUSED", "ECONNRESET", "ETIMEDOUT", "ENETUNREACH", "E401", "E403", "E503")


def skip(why):
    print(why)
    sys.exit(SKIPPED)


def fetch(source, folder, patience_s=240):
    """What package-lock.json in `source` names, in `folder`; fetched once, in so many seconds at most."""
    lock = (source / "package-lock.json").read_text()
    mark = folder / "fetched.json"
    if mark.is_file() and mark.read_text() == lock:
        return
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(source / name, folder)
    command = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1"]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=patience_s, check=False)
    except subprocess.TimeoutExpired:
        skip("the registry of npm does not answer")
    if done.returncode != 0:
        if any(word in done.stderr for word in NO_NETWORK):
            skip("the registry of npm cannot be reached")
        sys.exit(done.stderr)
    mark.write_text(lock)
