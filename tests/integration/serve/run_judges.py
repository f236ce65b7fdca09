#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Judges from npm look at a server: judge.mjs. run_judges.py PROGRAMS FAKE_NODE WORK"""

import pathlib
import shutil
import subprocess
import sys

import harness

SKIPPED = 77
HERE = pathlib.Path(__file__).parent
# What npm says where its registry cannot be reached.
NO_NETWORK = ("ENOTFOUND", "EAI_AGAIN", "ECONNREFUSED", "ECONNRESET", "ETIMEDOUT", "ENETUNREACH", "E401", "E403", "E503")


def skip(why):
    print(why)
    sys.exit(SKIPPED)


def fetch(folder):
    """Node's packages of package-lock.json, in `folder`; once."""
    lock = (HERE / "judges/package-lock.json").read_text()
    mark = folder / "fetched.json"
    if mark.is_file() and mark.read_text() == lock:
        return
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(HERE / "judges" / name, folder)
    command = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1"]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=240, check=False)
    except subprocess.TimeoutExpired:
        skip("the registry of npm does not answer")
    if done.returncode != 0:
        if any(word in done.stderr for word in NO_NETWORK):
            skip("the registry of npm cannot be reached")
        sys.exit(done.stderr)
    mark.write_text(lock)


def main():
    programs, fake_node, work = sys.argv[1:]
    if not shutil.which("npm") or not shutil.which("node"):
        skip("there is no npm here")
    packages = pathlib.Path(work) / "judges"
    fetch(packages)
    setting = harness.Setting(programs, fake_node)
    try:
        setting.start_node()
        server = setting.start_server("--write", "--token-file", setting.tokens)
        subprocess.run(["node", HERE / "judge.mjs", packages, f"http://127.0.0.1:{server.port}", setting.node, harness.TOKEN],
                       check=True)
    finally:
        setting.clean()


if __name__ == "__main__":
    main()
